//! What goes from the vertex to the pixel stage.

use super::body::components_read;
use super::reflection::Varying;
use super::{Options, Stage};
use crate::kernel::Slot;
use crate::raster::FogMode;
use std::fmt::Write;

/// How many coordinate sets there are.
pub(super) const SETS: usize = 8;

/// Locations are fixed, so that stages that were translated apart fit together.
const COLORS: u32 = SETS as u32;
const FOG: u32 = COLORS + 2;
const CLIP: u32 = FOG + 1;

/// The interface between the stages.
#[derive(Clone, Debug)]
pub(super) struct Varyings {
    /// Components of each coordinate set that are passed, 0 to 4.
    pub(super) sets: [usize; SETS],
    /// Which colours are passed.
    pub(super) colors: [bool; 2],
    /// Whether `oFog` is passed.
    pub(super) fog: bool,
    /// Whether the pixel stage looks at its position.
    pub(super) position: bool,
    /// Distances from clip planes that are passed.
    pub(super) clip: usize,
    flat: bool,
}

impl Varyings {
    /// What the pixel shader reads; without one, all that the vertex shader writes. Components are left out only
    /// where both stages are known.
    pub(super) fn new(
        vertex: Option<&Stage<'_>>,
        pixel: Option<&Stage<'_>>,
        options: &Options,
    ) -> Self {
        let mut sets = [0; SETS];
        let mut colors = [false; 2];
        let fog = options.fog;
        match (pixel, vertex) {
            (Some(pixel), _) => {
                let read = components_read(pixel.kernel, options);
                let of = |slot: Option<Slot>| slot.map(|slot| read[slot.index()]);
                for (set, components) in sets.iter_mut().enumerate() {
                    let last = of(Slot::texcoord(set)).and_then(|mask| mask.components().last());
                    *components = match last {
                        None => 0,
                        // A single x takes two components, so that it can be named.
                        Some(last) if vertex.is_some() => (last + 1).max(2),
                        Some(_) => 4,
                    };
                }
                for (i, color) in colors.iter_mut().enumerate() {
                    *color = of(Slot::input(i)).is_some_and(|mask| !mask.is_empty());
                }
            }
            (None, Some(vertex)) => {
                let written = |slot: Option<Slot>| {
                    slot.is_some_and(|slot| !vertex.kernel.written(slot).is_empty())
                };
                sets = std::array::from_fn(|set| match written(Slot::texcoord_output(set)) {
                    true => 4,
                    false => 0,
                });
                colors = std::array::from_fn(|i| written(Slot::color_output(i)));
            }
            (None, None) => {}
        }
        Self {
            sets,
            colors,
            fog: fog.is_some_and(|fog| fog.table == FogMode::None),
            position: vertex.is_some()
                || options.mapped_depth
                || fog.is_some_and(|fog| fog.table != FogMode::None),
            clip: options.clip_planes.into(),
            flat: options.flat_shading,
        }
    }

    /// Whether the pixel stage has a parameter: the vertex stage always gives a position, which only table fog and the mapping of depths look at.
    pub(super) fn reach_pixel(&self) -> bool {
        self.position || !self.list().is_empty()
    }

    /// The varyings by location.
    pub(super) fn list(&self) -> Vec<Varying> {
        let one = |name: String, location: u32, components: usize, flat: bool| Varying {
            name,
            location,
            components,
            flat,
        };
        let mut list = Vec::new();
        for (set, components) in self.sets.into_iter().enumerate() {
            if components > 0 {
                list.push(one(format!("t{set}"), set as u32, components, false));
            }
        }
        for (i, passed) in self.colors.into_iter().enumerate() {
            if passed {
                list.push(one(format!("v{i}"), COLORS + i as u32, 4, self.flat));
            }
        }
        if self.fog {
            list.push(one("fog".into(), FOG, 1, false));
        }
        for first in (0..self.clip).step_by(4) {
            let block = first as u32 / 4;
            list.push(one(format!("clip{block}"), CLIP + block, 4, false));
        }
        list
    }

    /// The structure, or nothing if it has no members.
    pub(super) fn structure(&self) -> Option<String> {
        let list = self.list();
        if list.is_empty() && !self.position {
            return None;
        }
        let mut text = String::from("struct Varyings {\n");
        if self.position {
            text.push_str("    @builtin(position) position: vec4f,\n");
        }
        for varying in list {
            let flat = if varying.flat {
                " @interpolate(flat)"
            } else {
                ""
            };
            let (name, location) = (&varying.name, varying.location);
            _ = write!(text, "    @location({location}){flat} {name}: ");
            _ = match varying.components {
                1 => writeln!(text, "f32,"),
                n => writeln!(text, "vec{n}f,"),
            };
        }
        Some(text + "}\n")
    }
}
