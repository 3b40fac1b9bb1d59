//! What instructions, registers, modifiers, notations, versions, rules, hardware models and numeric choices mean, as pages for
//! people.
//!
//! Nothing is known here: every sentence and every number of a page comes from the row that parser, validator and encoder
//! work with, examples are encoded while one looks, and what breaks a rule is judged by the rule itself.
//!
//! ```
//! let pages = texcrd::explain::find("LRP", None).expect("it is an instruction");
//! assert_eq!(pages[0].title, "linear interpolation");
//! assert!(pages[0].text(80).contains("d = s0 * s1 + (1 - s0) * s2"));
//! ```

mod computing;
mod encoding;
mod index;
mod instruction;
mod macros;
mod modifier;
mod names;
mod notation;
mod page;
mod register;
mod rule;
mod subject;
mod version;

#[cfg(test)]
mod tests;

pub use computing::{model, models, policies, policy};
pub use index::index;
pub use instruction::{declaration, instruction, operand_names, written};
pub use macros::token_macro;
pub use modifier::{modifier, result};
pub use names::{Unknown, find, subjects};
pub use notation::notation;
pub use page::{Fact, LEAST_WIDTH, Page, Part, Role};
pub use register::register;
pub use rule::rule;
pub use subject::Subject;
pub use version::version;
