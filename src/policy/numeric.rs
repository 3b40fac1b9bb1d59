//! Numeric choices: what instructions do where documents and hardware did not agree.

use super::{UnknownName, named};
use std::fmt;

named! {
    /// What a product is of which a factor is 0.
    ZeroProduct "value of zero-product";
    Zero "zero" "0, also if the other factor is infinite or NaN.",
    Ieee "ieee" "What IEEE 754 says: NaN if the other factor is infinite or NaN; the zero has a sign.",
}

named! {
    /// What stands for infinity where a reciprocal or a logarithm of 0 is asked for.
    OfZero "value of rcp-zero";
    Largest "largest" "The largest finite number, 3.402823466e38, so that sums and products stay numbers.",
    Infinity "infinity" "Infinity.",
}

impl OfZero {
    /// The number: what `rcp` and `rsq` give; the logarithm gives it with a minus.
    pub const fn value(self) -> f32 {
        match self {
            Self::Largest => f32::MAX,
            Self::Infinity => f32::INFINITY,
        }
    }
}

named! {
    /// Which slot of the swizzled source `rcp`, `rsq`, `exp`, `log`, `expp` and `logp` read.
    ScalarSlot "value of scalar";
    W "w" "The fourth: without a swizzle w, of `.xyz` z.",
    X "x" "The first: without a swizzle x.",
}

impl ScalarSlot {
    /// The number of the slot.
    pub const fn slot(self) -> usize {
        match self {
            Self::W => 3,
            Self::X => 0,
        }
    }
}

named! {
    /// What `logp` writes.
    LogpLayout "value of logp";
    Parts "parts" "Exponent, mantissa, logarithm in partial precision, 1.",
    Logarithm "logarithm" "The logarithm in every component, as `log`.",
}

named! {
    /// How long constants hold that a shader defines itself.
    DefLifetime "value of def";
    WhenSet "when-set" "They are loaded when the shader is set: a constant that is set later replaces them.",
    Always "always" "They belong to the shader: a constant that is set has no effect on them.",
}

/// All numeric choices. The default is the specification's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Policies {
    /// `zero-product`
    pub zero_product: ZeroProduct,
    /// `rcp-zero`
    pub of_zero: OfZero,
    /// `scalar`
    pub scalar: ScalarSlot,
    /// `logp`
    pub logp: LogpLayout,
    /// `def`
    pub def: DefLifetime,
}

/// A value that a policy may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PolicyValue {
    /// Its name.
    pub name: &'static str,
    /// What it means.
    pub about: &'static str,
}

/// One numeric choice, for whoever lists them.
#[derive(Clone, Copy, Debug)]
pub struct Policy {
    /// Its name, as in `--policy NAME=VALUE`.
    pub name: &'static str,
    /// What is chosen.
    pub about: &'static str,
    /// Why there is a choice: who says and did what.
    pub why: &'static str,
    values: fn() -> Vec<PolicyValue>,
    get: fn(&Policies) -> &'static str,
    set: fn(&mut Policies, &str) -> Result<(), UnknownName>,
}

impl Policy {
    /// Every policy, in the order of [`Policies`].
    pub fn all() -> impl Iterator<Item = &'static Policy> {
        POLICIES.iter()
    }

    /// The policy of this name, in any case of letters.
    pub fn named(name: &str) -> Option<&'static Policy> {
        Self::all().find(|policy| policy.name.eq_ignore_ascii_case(name))
    }

    /// The values that it may have, the default first.
    pub fn values(&self) -> Vec<PolicyValue> {
        (self.values)()
    }

    /// The name of the value that it has.
    pub fn get(&self, policies: &Policies) -> &'static str {
        (self.get)(policies)
    }
}

/// A row of the table: the name, the field, the type of its values, and two sentences.
macro_rules! policies {
    ($($name:literal $field:ident $type:ident $about:literal $why:literal;)*) => {
        static POLICIES: &[Policy] = &[$(Policy {
            name: $name,
            about: $about,
            why: $why,
            values: || {
                $type::all()
                    .map(|value| PolicyValue {
                        name: value.name(),
                        about: value.about(),
                    })
                    .collect()
            },
            get: |policies| policies.$field.name(),
            set: |policies, value| {
                policies.$field = value.parse()?;
                Ok(())
            },
        }),*];
    };
}

policies! {
    "zero-product" zero_product ZeroProduct
    "A product with a factor of 0, in mul, mad, dp3, dp4, m#x#, lrp, dst and lit."
    "The GeForce 3 had to give 0, and the parts of Direct3D 9 did; the documents do not say.";
    "rcp-zero" of_zero OfZero
    "What rcp and rsq give of 0, and with a minus log and logp."
    "The documents write infinity in words and the largest number in code; parts of either kind were sold.";
    "scalar" scalar ScalarSlot
    "The slot of the source that rcp, rsq, exp, log, expp and logp read where its swizzle leaves more than one."
    "The code in the documents reads w, their prose says x; programs that were sold counted on w.";
    "logp" logp LogpLayout
    "What logp writes into which component."
    "The documents of DirectX 8 and the GeForce 3 have four parts, those of DirectX 9 the plain logarithm.";
    "def" def DefLifetime
    "Whether a constant that is set from outside replaces what def says."
    "Direct3D 8 loaded definitions when the shader was set; in Direct3D 9 they belong to the shader.";
}

/// A setting `NAME=VALUE` that cannot be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WrongPolicy {
    /// There is no `=` in it.
    Form,
    /// No policy or no value has this name.
    Name(UnknownName),
}

impl fmt::Display for WrongPolicy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form => f.write_str("write it as NAME=VALUE"),
            Self::Name(unknown) => unknown.fmt(f),
        }
    }
}

impl std::error::Error for WrongPolicy {}

impl Policies {
    /// Sets a policy by what the command line says, `NAME=VALUE`.
    ///
    /// # Errors
    /// [`WrongPolicy`], and nothing is changed.
    pub fn set(&mut self, setting: &str) -> Result<(), WrongPolicy> {
        let (name, value) = setting.split_once('=').ok_or(WrongPolicy::Form)?;
        let policy = Policy::named(name.trim()).ok_or_else(|| {
            WrongPolicy::Name(UnknownName {
                what: "policy",
                name: name.trim().into(),
                known: Policy::all().map(|policy| policy.name).collect(),
            })
        })?;
        (policy.set)(self, value.trim()).map_err(WrongPolicy::Name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_of_every_policy_can_be_set_and_read() {
        for policy in Policy::all() {
            let mut policies = Policies::default();
            let values = policy.values();
            assert_eq!(policy.get(&policies), values[0].name, "{}", policy.name);
            assert!(values.len() > 1 && values.iter().all(|value| !value.about.is_empty()));
            for value in &values {
                policies
                    .set(&format!("{} = {}", policy.name, value.name))
                    .unwrap();
                assert_eq!(policy.get(&policies), value.name);
            }
            // The last is no default, and no other policy has changed.
            let other = Policy::all().filter(|p| p.name != policy.name);
            assert!({ other }.all(|p| p.get(&policies) == p.values()[0].name));
        }
    }

    #[test]
    fn wrong_settings_say_what_there_is() {
        let mut policies = Policies::default();
        let mut wrong = |setting| policies.set(setting).unwrap_err().to_string();
        assert!(wrong("rcp").contains("NAME=VALUE"));
        assert!(wrong("rcp=0").contains("zero-product, rcp-zero, scalar, logp, def"));
        assert!(wrong("scalar=z").contains("`z`; it is one of w, x"));
        assert_eq!(policies, Policies::default());
    }
}
