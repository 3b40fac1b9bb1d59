//! Pipelines from translations, each made once.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::state::FixedState;
use super::texture::view_dimension;
use super::{Device, GpuError, VertexLayout};
use crate::isa::ShaderKind;
use crate::wgsl::{Reflection, Resource, Translation};

/// The layouts of bind groups 0 (uniform blocks) and 1 (textures and samplers) of a translation.
pub fn bind_group_layouts(
    device: &wgpu::Device,
    reflection: &Reflection,
) -> [wgpu::BindGroupLayout; 2] {
    [0, 1].map(|group| {
        let bindings = reflection.bindings.iter();
        let entries: Vec<_> = bindings
            .filter(|binding| binding.group == group)
            .map(|binding| layout_entry(binding.binding, &binding.resource))
            .collect();
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &entries,
        })
    })
}

fn layout_entry(binding: u32, resource: &Resource) -> wgpu::BindGroupLayoutEntry {
    let (visibility, ty) = match resource {
        Resource::Uniform { stage, size, .. } => (
            match stage {
                ShaderKind::Vertex => wgpu::ShaderStages::VERTEX,
                ShaderKind::Pixel => wgpu::ShaderStages::FRAGMENT,
            },
            wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: std::num::NonZeroU64::new(u64::from(*size)),
            },
        ),
        Resource::Texture { dimension, .. } => (
            wgpu::ShaderStages::FRAGMENT,
            wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: true },
                view_dimension: view_dimension(*dimension),
                multisampled: false,
            },
        ),
        Resource::Sampler { .. } => (
            wgpu::ShaderStages::FRAGMENT,
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        ),
    };
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty,
        count: None,
    }
}

/// All that a pipeline depends on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Key {
    source: String,
    vertices: VertexLayout,
    fixed: FixedState,
    format: wgpu::TextureFormat,
}

/// A pipeline and the layouts of its bind groups.
#[derive(Debug)]
pub(super) struct Pipeline {
    pub(super) pipeline: wgpu::RenderPipeline,
    pub(super) groups: [wgpu::BindGroupLayout; 2],
}

/// The pipelines that were made so far.
#[derive(Debug, Default)]
pub(super) struct Pipelines {
    known: HashMap<Key, Pipeline>,
}

impl Pipelines {
    /// The pipeline for a translation of a vertex and a pixel shader, drawing into one target of this format.
    ///
    /// # Errors
    /// [`GpuError::Device`] if the device does not take the shader.
    pub(super) fn get(
        &mut self,
        device: &Device,
        translation: &Translation,
        vertices: VertexLayout,
        fixed: FixedState,
        format: wgpu::TextureFormat,
    ) -> Result<&Pipeline, GpuError> {
        let key = Key {
            source: translation.source.clone(),
            vertices,
            fixed,
            format,
        };
        match self.known.entry(key) {
            Entry::Occupied(known) => Ok(known.into_mut()),
            Entry::Vacant(place) => {
                let pipeline = create(device, place.key(), &translation.reflection);
                device.check()?;
                Ok(place.insert(pipeline))
            }
        }
    }
}

fn create(device: &Device, key: &Key, reflection: &Reflection) -> Pipeline {
    let groups = bind_group_layouts(&device.device, reflection);
    let module = (device.device).create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(key.source.as_str().into()),
    });
    let layout = (device.device).create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(&groups[0]), Some(&groups[1])],
        immediate_size: 0,
    });
    let buffers: Vec<_> = key.vertices.buffers().into_iter().map(Some).collect();
    let entry = |stage: &Option<crate::wgsl::StageReflection>| {
        stage.as_ref().map(|stage| stage.entry.clone())
    };
    let (vertex_entry, pixel_entry) = (entry(&reflection.vertex), entry(&reflection.pixel));
    let targets = [Some(wgpu::ColorTargetState {
        format: key.format,
        blend: key.fixed.blend,
        write_mask: key.fixed.write_mask,
    })];
    let description = wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: vertex_entry.as_deref(),
            compilation_options: Default::default(),
            buffers: &buffers,
        },
        primitive: key.fixed.primitive,
        depth_stencil: Some(key.fixed.depth_stencil.clone()),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: pixel_entry.as_deref(),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    };
    Pipeline {
        pipeline: device.device.create_render_pipeline(&description),
        groups,
    }
}
