//! Says what each dialect has against a listing.
//!
//! `cargo run --no-default-features --example check water.psh`

use std::error::Error;
use texcrd::policy::Dialect;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("which listing?")?;
    let text = std::fs::read(&path)?;
    for dialect in Dialect::all() {
        let report = texcrd::validate(&text, dialect);
        let verdict = if report.is_accepted() {
            "takes it"
        } else {
            "refuses it"
        };
        println!("{dialect} {verdict}");
        for diagnostic in report.diagnostics() {
            let line = report.place(diagnostic).map_or(0, |place| place.line);
            let (code, message) = (diagnostic.rule.id, &diagnostic.message);
            println!("  line {line}: {code}: {message}");
        }
    }
    Ok(())
}
