//! Choices that a person makes about how a listing is judged and run, as plain values.

mod model;
mod named;
mod numeric;

pub use model::{Aspect, Model};
pub use named::UnknownName;
use named::named;
pub use numeric::{
    DefLifetime, LogpLayout, OfZero, Policies, Policy, PolicyValue, ScalarSlot, WrongPolicy,
    ZeroProduct,
};

named! {
    /// By whose rules a listing is judged.
    Dialect "dialect";
    D3d8 "d3d8" "What the Direct3D 8 runtime accepted, with a warning where its own documents forbade it.",
    D3d9 "d3d9" "What the assembler and the runtime of Direct3D 9 accepted of these versions.",
    Lenient "lenient" "Whatever has a meaning: a listing is refused only for what cannot be run.",
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_are_read_by_the_name_they_print() {
        for name in ["d3d8", "d3d9", "lenient"] {
            assert_eq!(name.parse::<Dialect>().unwrap().to_string(), name);
        }
        for name in ["float", "gf3", "r200"] {
            assert_eq!(name.parse::<Model>().unwrap().to_string(), name);
        }
        assert_eq!("D3D9".parse(), Ok(Dialect::D3d9));
        assert_eq!(Dialect::default(), Dialect::D3d8);
        assert_eq!(Model::default(), Model::Float);
        let unknown = "d3d7".parse::<Dialect>().unwrap_err().to_string();
        assert!(unknown.contains("d3d7") && unknown.contains("d3d8, d3d9, lenient"));
        let unknown = "nv20".parse::<Model>().unwrap_err().to_string();
        assert!(unknown.contains("hardware model `nv20`") && unknown.contains("float, gf3, r200"));
    }
}
