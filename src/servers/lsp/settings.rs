//! What a person chooses: the dialect, macros, folders of included files, inlay hints.

use serde_json::Value;
use std::path::PathBuf;
use std::str::FromStr;
use texcrd::policy::Dialect;
use texcrd::preprocess::Definition;

/// Which inlay hints are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Hints {
    /// The slots of each phase, and those of instructions that take more than one.
    #[default]
    Totals,
    /// Behind each instruction the slots so far, too.
    Running,
    Off,
}

impl FromStr for Hints {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        match name {
            "totals" => Ok(Self::Totals),
            "running" => Ok(Self::Running),
            "off" => Ok(Self::Off),
            _ => Err(format!("`{name}` is none of totals, running, off")),
        }
    }
}

/// The settings, by these names in `initializationOptions` and in the section `texcrd` of the client's configuration.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Settings {
    /// `dialect`: `d3d8`, `d3d9`, `lenient`.
    pub dialect: Dialect,
    /// `defines`: texts as `-D` takes them.
    pub defines: Vec<Definition>,
    /// `includes`: folders as `-I` takes them, relative ones to the folder of the workspace.
    pub includes: Vec<PathBuf>,
    /// `inlayHints`: `totals`, `running`, `off`.
    pub hints: Hints,
}

impl Settings {
    /// Takes what a client says; what it leaves out stays. What makes no sense stays, too, and is told.
    pub(super) fn take(&mut self, given: &Value) -> Vec<String> {
        let mut wrong = Vec::new();
        // Some clients send the whole configuration, some the section.
        let given = given.get("texcrd").unwrap_or(given);
        if let Some(dialect) = one(given, "dialect", &mut wrong) {
            self.dialect = dialect;
        }
        if let Some(hints) = one(given, "inlayHints", &mut wrong) {
            self.hints = hints;
        }
        if let Some(defines) = list(given, "defines", &mut wrong) {
            self.defines = defines;
        }
        if let Some(includes) = list(given, "includes", &mut wrong) {
            self.includes = includes;
        }
        wrong
    }
}

fn one<T: FromStr<Err: ToString>>(given: &Value, name: &str, wrong: &mut Vec<String>) -> Option<T> {
    let value = given.get(name).filter(|value| !value.is_null())?;
    let read = match value.as_str() {
        Some(text) => text.parse().map_err(|error: T::Err| error.to_string()),
        None => Err("it must be a text".to_string()),
    };
    read.map_err(|why| wrong.push(format!("setting `{name}`: {why}")))
        .ok()
}

/// Those of a list that make sense.
fn list<T: FromStr<Err: ToString>>(
    given: &Value,
    name: &str,
    wrong: &mut Vec<String>,
) -> Option<Vec<T>> {
    let value = given.get(name).filter(|value| !value.is_null())?;
    let Some(texts) = value.as_array() else {
        wrong.push(format!("setting `{name}`: it must be a list of texts"));
        return None;
    };
    let mut read = Vec::new();
    for text in texts {
        let text = text.as_str().ok_or_else(|| format!("{text} is no text"));
        match text.and_then(|text| text.parse().map_err(|error: T::Err| error.to_string())) {
            Ok(value) => read.push(value),
            Err(why) => wrong.push(format!("setting `{name}`: {why}")),
        }
    }
    Some(read)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn settings_come_whole_or_in_part_and_what_is_wrong_is_told() {
        let mut settings = Settings::default();
        let given = json!({ "dialect": "lenient", "defines": ["FOG", "A=2"], "includes": ["inc"], "path": "texcrd" });
        assert!(settings.take(&given).is_empty());
        assert_eq!(settings.dialect, Dialect::Lenient);
        assert_eq!((settings.defines.len(), settings.includes.len()), (2, 1));
        let given = json!({ "texcrd": { "dialect": "d3d7", "inlayHints": "off", "defines": ["1A", 3, "B"], "includes": null } });
        let wrong = settings.take(&given);
        assert_eq!(wrong.len(), 3, "{wrong:?}");
        assert!(wrong[0].contains("d3d7"), "{wrong:?}");
        assert_eq!(settings.dialect, Dialect::Lenient);
        assert_eq!(settings.hints, Hints::Off);
        assert_eq!((settings.defines.len(), settings.includes.len()), (1, 1));
        for nothing in [json!(null), json!([]), json!(7), json!({})] {
            assert!(settings.take(&nothing).is_empty());
        }
    }
}
