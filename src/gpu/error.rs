//! What can go wrong on the way to a picture from the GPU.

use std::fmt;

use crate::scene::RenderError;
use crate::wgsl::TranslateError;

/// Why something could not be done on the GPU. Its `Display` text is a sentence for people.
#[derive(Clone, Debug, PartialEq)]
pub enum GpuError {
    /// There is no adapter at all.
    NoAdapter,
    /// No adapter has this name or number.
    NoSuchAdapter {
        /// What was asked for.
        wanted: String,
        /// The names of those there are, in the order of [`super::adapters`].
        known: Vec<String>,
    },
    /// The adapter gave no device.
    Refused {
        /// The name of the adapter.
        adapter: String,
        /// Why.
        reason: String,
    },
    /// Something needs more than the device can do.
    Limit {
        /// What was needed, as the beginning of a sentence: "a picture of 40000×10 pixels".
        what: String,
        /// What there is.
        limit: String,
    },
    /// A render state that WebGPU, or this device, cannot express.
    Unsupported {
        /// The name of the draw.
        draw: String,
        /// The state and its value.
        state: String,
    },
    /// A draw's shaders could not be translated.
    Translate {
        /// The name of the draw.
        draw: String,
        /// Why.
        error: TranslateError,
    },
    /// The same error that the CPU path would report.
    Render(RenderError),
    /// The device refused what it was given, which is a fault of this crate or of the driver.
    Device(String),
    /// The device is gone: it was reset, removed, or hung.
    Lost(String),
}

impl fmt::Display for GpuError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAdapter => f.write_str(
                "no GPU adapter was found; a software one for Vulkan comes with the packages \
                 mesa-vulkan-drivers and libvulkan1 (Debian, Ubuntu)",
            ),
            Self::NoSuchAdapter { wanted, known } => {
                write!(f, "there is no adapter `{wanted}`; there are")?;
                for (number, name) in known.iter().enumerate() {
                    let comma = if number == 0 { "" } else { "," };
                    write!(f, "{comma} {number} ({name})")?;
                }
                Ok(())
            }
            Self::Refused { adapter, reason } => {
                write!(f, "the adapter {adapter} gives no device: {reason}")
            }
            Self::Limit { what, limit } => write!(f, "this device cannot hold {what}: {limit}"),
            Self::Unsupported { draw, state } => {
                write!(f, "draw `{draw}`: {state} cannot be had on this device")
            }
            Self::Translate { draw, error } => write!(f, "draw `{draw}`: {error}"),
            Self::Render(error) => error.fmt(f),
            Self::Device(reason) => write!(f, "the device refused its work: {reason}"),
            Self::Lost(reason) => write!(f, "the device was lost: {reason}"),
        }
    }
}

impl std::error::Error for GpuError {}

impl From<RenderError> for GpuError {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}
