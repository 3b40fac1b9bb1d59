//! `adapters`: what there is to draw with.

use super::{Failure, Format, Outcome, print, print_json};
use serde_json::json;
use texcrd::gpu::{GpuError, adapters};

/// Lists the GPU adapters, in the order in which one is chosen.
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let adapters = adapters();
    if adapters.is_empty() {
        return Err(Failure::Io(GpuError::NoAdapter.to_string()));
    }
    match arguments.format {
        Format::Text => {
            let lines = adapters.iter().enumerate().map(|(number, adapter)| {
                let mut line = format!("{number}  {adapter}  {}", adapter.driver);
                if !adapter.float_targets {
                    line.push_str("; no float targets");
                }
                if !adapter.float_filtering {
                    line.push_str("; floats are filtered with 16 bits");
                }
                line + "\n"
            });
            print(&lines.collect::<String>())
        }
        Format::Json => {
            let list: Vec<_> = adapters
                .iter()
                .map(|adapter| {
                    json!({
                        "name": adapter.name,
                        "backend": adapter.backend,
                        "kind": adapter.kind,
                        "driver": adapter.driver,
                        "float_targets": adapter.float_targets,
                        "float_filtering": adapter.float_filtering,
                    })
                })
                .collect();
            print_json(&json!(list))
        }
    }
}
