//! Adapters, and the device that is made of one.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use super::GpuError;

/// What is known of an adapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdapterInfo {
    /// Its name, as the driver gives it.
    pub name: String,
    /// The programming interface it is reached by: `vulkan`, `gl`, `metal`, `dx12`.
    pub backend: String,
    /// What it is: `discrete`, `integrated`, `virtual`, `software`, `other`.
    pub kind: &'static str,
    /// Name and version of the driver, as far as it tells them.
    pub driver: String,
    /// Whether colour targets of 32-bit floats can be drawn into, which exact comparisons of arithmetic need.
    pub float_targets: bool,
    /// Whether textures of 32-bit floats can be filtered. Without it, formats that eight bits do not hold exactly
    /// (signed ones, floats) are kept as 16-bit floats.
    pub float_filtering: bool,
}

impl AdapterInfo {
    fn of(adapter: &wgpu::Adapter) -> Self {
        let info = adapter.get_info();
        let float = adapter.get_texture_format_features(wgpu::TextureFormat::Rgba32Float);
        let driver = [info.driver.as_str(), info.driver_info.as_str()];
        Self {
            name: info.name,
            backend: info.backend.to_string(),
            kind: match info.device_type {
                wgpu::DeviceType::DiscreteGpu => "discrete",
                wgpu::DeviceType::IntegratedGpu => "integrated",
                wgpu::DeviceType::VirtualGpu => "virtual",
                wgpu::DeviceType::Cpu => "software",
                wgpu::DeviceType::Other => "other",
            },
            driver: driver.join(" ").trim().to_owned(),
            float_targets: float
                .allowed_usages
                .contains(wgpu::TextureUsages::RENDER_ATTACHMENT),
            float_filtering: adapter
                .features()
                .contains(wgpu::Features::FLOAT32_FILTERABLE),
        }
    }
}

impl fmt::Display for AdapterInfo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}, {})", self.name, self.backend, self.kind)
    }
}

/// The adapters in the order in which one is chosen: real GPUs before software, then as the system lists them. OpenGL
/// counts only where there is nothing else.
fn ordered() -> Vec<(wgpu::Adapter, AdapterInfo)> {
    // The switch that programs with `wgpu` share, for whoever wants OpenGL, or nothing.
    let allowed = wgpu::Backends::from_env().unwrap_or(wgpu::Backends::all());
    let of = |backends: wgpu::Backends| {
        let backends = backends & allowed;
        let mut description = wgpu::InstanceDescriptor::new_without_display_handle();
        description.backends = backends;
        // Checks by the driver's own layers are for those who write drivers, and print to the terminal.
        description.flags = wgpu::InstanceFlags::empty();
        pollster::block_on(wgpu::Instance::new(description).enumerate_adapters(backends))
    };
    let mut found = of(wgpu::Backends::PRIMARY);
    if found.is_empty() {
        // OpenGL can do less, lists the same cards again, and some of its drivers print to the terminal.
        found = of(wgpu::Backends::SECONDARY);
    }
    let mut adapters: Vec<_> = found
        .into_iter()
        .map(|adapter| {
            let info = AdapterInfo::of(&adapter);
            (adapter, info)
        })
        .collect();
    adapters.sort_by_key(|(_, info)| match info.kind {
        "discrete" => 0,
        "integrated" => 1,
        "software" => 3,
        _ => 2,
    });
    adapters
}

/// The adapters of this machine, those first that are chosen first. Those of OpenGL are listed only where there are no
/// others. The environment variable `WGPU_BACKEND` (`vulkan`, `gl`, `metal`, `dx12`, separated by commas) leaves only the
/// adapters of these.
pub fn adapters() -> Vec<AdapterInfo> {
    ordered().into_iter().map(|(_, info)| info).collect()
}

/// What the device has complained about since it was last asked.
#[derive(Debug, Default)]
struct Complaints {
    error: Option<String>,
    lost: Option<String>,
}

/// A device to draw with, off-screen.
///
/// Errors of the device never panic: they are collected and returned by whatever waits for the device.
#[derive(Debug)]
pub struct Device {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    info: AdapterInfo,
    complaints: Arc<Mutex<Complaints>>,
}

impl Device {
    /// Opens an adapter: the first of [`adapters`], or the one with this number in that list, or the first whose name
    /// or interface contains this text (capital and small letters are the same).
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`], [`GpuError::NoSuchAdapter`], [`GpuError::Refused`].
    pub fn open(wanted: Option<&str>) -> Result<Self, GpuError> {
        let mut found = ordered();
        if found.is_empty() {
            return Err(GpuError::NoAdapter);
        }
        let number = match wanted {
            None => Some(0),
            Some(text) => position(text, found.iter().map(|(_, info)| info)),
        };
        let Some(number) = number.filter(|number| *number < found.len()) else {
            return Err(GpuError::NoSuchAdapter {
                wanted: wanted.unwrap_or_default().to_owned(),
                known: found.iter().map(|(_, info)| info.to_string()).collect(),
            });
        };
        let (adapter, info) = found.swap_remove(number);
        let wished = wgpu::Features::FLOAT32_FILTERABLE
            | wgpu::Features::DEPTH32FLOAT_STENCIL8
            | wgpu::Features::POLYGON_MODE_LINE;
        let request = wgpu::DeviceDescriptor {
            label: Some("texcrd"),
            required_features: adapter.features() & wished,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let opened = pollster::block_on(adapter.request_device(&request));
        let (device, queue) = opened.map_err(|error| GpuError::Refused {
            adapter: info.to_string(),
            reason: error.to_string(),
        })?;
        Ok(Self::taking(info, device, queue))
    }

    /// A device that was opened elsewhere, with features of its own choice. Its errors and its loss are reported here from
    /// now on.
    pub fn of(adapter: &wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        Self::taking(AdapterInfo::of(adapter), device, queue)
    }

    fn taking(info: AdapterInfo, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let complaints = Arc::new(Mutex::new(Complaints::default()));
        let errors = Arc::clone(&complaints);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            // The first error is the cause, later ones follow from it.
            let mut complaints = errors.lock().unwrap_or_else(PoisonError::into_inner);
            complaints.error.get_or_insert_with(|| error.to_string());
        }));
        let losses = Arc::clone(&complaints);
        device.set_device_lost_callback(move |_, message| {
            let mut complaints = losses.lock().unwrap_or_else(PoisonError::into_inner);
            complaints.lost.get_or_insert(message);
        });
        Self {
            device,
            queue,
            info,
            complaints,
        }
    }

    /// The adapter that this device was made of.
    pub fn adapter(&self) -> &AdapterInfo {
        &self.info
    }

    /// The device itself, to draw with beside this crate.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The queue of the device.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// Whether the device was opened with a feature.
    pub(super) fn has(&self, feature: wgpu::Features) -> bool {
        self.device.features().contains(feature)
    }

    /// What the device has complained about since the last call.
    ///
    /// # Errors
    /// [`GpuError::Lost`] for ever after a loss, [`GpuError::Device`] once.
    pub(super) fn check(&self) -> Result<(), GpuError> {
        let complaints = || (self.complaints.lock()).unwrap_or_else(PoisonError::into_inner);
        let error = complaints().error.take();
        if error.is_some() {
            // What is sent to a lost device is refused before the loss is told, which happens in here.
            let _ = self.device.poll(wgpu::PollType::Poll);
        }
        if let Some(reason) = &complaints().lost {
            return Err(GpuError::Lost(reason.clone()));
        }
        error.map_or(Ok(()), |error| Err(GpuError::Device(error)))
    }

    /// Refuses a picture or texture that the device cannot hold.
    ///
    /// # Errors
    /// [`GpuError::Limit`].
    pub(super) fn check_size(&self, what: &str, [width, height]: [u32; 2]) -> Result<(), GpuError> {
        let most = self.device.limits().max_texture_dimension_2d;
        if width.max(height) <= most {
            return Ok(());
        }
        Err(GpuError::Limit {
            what: format!("{what} of {width}×{height}"),
            limit: format!("at most {most} on a side"),
        })
    }

    /// Waits until everything that was submitted is done.
    ///
    /// # Errors
    /// As [`Self::check`].
    pub(super) fn wait(&self) -> Result<(), GpuError> {
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.check()?;
        waited
            .map(|_| ())
            .map_err(|error| GpuError::Lost(error.to_string()))
    }
}

/// The number that a text names: a number itself, or the first adapter with the text in its name or interface.
fn position<'a>(text: &str, mut infos: impl Iterator<Item = &'a AdapterInfo>) -> Option<usize> {
    if let Ok(number) = text.parse() {
        return Some(number);
    }
    let wanted = text.to_lowercase();
    infos.position(|info| info.to_string().to_lowercase().contains(&wanted))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adapters_are_named_by_number_name_or_interface() {
        let info = |name: &str, backend: &str| AdapterInfo {
            name: name.into(),
            backend: backend.into(),
            kind: "other",
            driver: String::new(),
            float_targets: true,
            float_filtering: true,
        };
        let infos = [info("First Card", "vulkan"), info("Second Card", "gl")];
        let find = |text| position(text, infos.iter());
        assert_eq!(find("1"), Some(1));
        assert_eq!(find("7"), Some(7)); // `open` finds that there is none.
        assert_eq!(find("second"), Some(1));
        assert_eq!(find("CARD"), Some(0));
        assert_eq!(find("gl"), Some(1));
        assert_eq!(find("third"), None);
    }
}
