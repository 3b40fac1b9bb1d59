//! A window frame.

use glam::{Mat4, Vec2, Vec3};

use super::shape::length;
use super::{Cuboid, Mesh, MeshError};

/// A rectangular window frame around the origin in the plane z = 0, for a pane of `width` × `height`: four outer bars around
/// the pane and inner bars (mullions and transoms) across it. One repeat of the texture covers one unit of length.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "scene",
    derive(serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct WindowFrame {
    /// Width of the pane inside the outer bars, above 0. Default 1.
    pub width: f32,
    /// Height of the pane inside the outer bars, above 0. Default 1.
    pub height: f32,
    /// Thickness of the outer bars in the plane of the window, above 0; inner bars have 0.6 of it. Default 0.08.
    pub bar: f32,
    /// Depth of the outer bars along z, above 0; the inner bars have 0.7 and 0.6 of it. Default 0.1.
    pub depth: f32,
    /// Upright inner bars, 0 to 64, evenly spaced. Default 0.
    pub mullions: u32,
    /// Level inner bars, 0 to 64, evenly spaced. Default 0.
    pub transoms: u32,
}

impl Default for WindowFrame {
    fn default() -> Self {
        Self {
            width: 1.0,
            height: 1.0,
            bar: 0.08,
            depth: 0.1,
            mullions: 0,
            transoms: 0,
        }
    }
}

impl WindowFrame {
    /// Makes the mesh.
    ///
    /// # Errors
    /// A field outside its limits.
    pub fn build(&self) -> Result<Mesh, MeshError> {
        for (name, value) in [
            ("width", self.width),
            ("height", self.height),
            ("bar", self.bar),
            ("depth", self.depth),
        ] {
            length("window_frame", name, value)?;
        }
        for (name, value) in [("mullions", self.mullions), ("transoms", self.transoms)] {
            if value > 64 {
                let rule = format!("is {value}; it must be 0 to 64");
                return Err(MeshError::Parameter {
                    shape: "window_frame",
                    name,
                    rule,
                });
            }
        }
        let Self {
            width,
            height,
            bar,
            depth,
            ..
        } = *self;
        let mut parts = Vec::new();
        for side in [-1.0, 1.0] {
            let (x, y) = (side * (width + bar) * 0.5, side * (height + bar) * 0.5);
            parts.push(beam(
                Vec3::new(0.0, y, 0.0),
                Vec3::new(width + 2.0 * bar, bar, depth),
            )?);
            parts.push(beam(Vec3::new(x, 0.0, 0.0), Vec3::new(bar, height, depth))?);
        }
        // Two depths, so that no two faces lie in one plane where inner bars cross.
        for i in 0..self.mullions {
            let x = ((i + 1) as f32 / (self.mullions + 1) as f32 - 0.5) * width;
            parts.push(beam(
                Vec3::new(x, 0.0, 0.0),
                Vec3::new(bar * 0.6, height, depth * 0.7),
            )?);
        }
        for i in 0..self.transoms {
            let y = ((i + 1) as f32 / (self.transoms + 1) as f32 - 0.5) * height;
            parts.push(beam(
                Vec3::new(0.0, y, 0.0),
                Vec3::new(width, bar * 0.6, depth * 0.6),
            )?);
        }
        Mesh::merge(&parts)
    }
}

/// A box with texture coordinates in units of length.
fn beam(center: Vec3, size: Vec3) -> Result<Mesh, MeshError> {
    let faces = Cuboid {
        size: size.to_array(),
        ..Cuboid::default()
    }
    .build()?;
    let mut mesh = faces.transformed(Mat4::from_translation(center))?;
    for (texcoord, (tangent, bitangent)) in mesh
        .texcoords
        .iter_mut()
        .zip(mesh.tangents.iter().zip(&mesh.bitangents))
    {
        *texcoord *= Vec2::new((*tangent * size).length(), (*bitangent * size).length());
    }
    Ok(mesh)
}
