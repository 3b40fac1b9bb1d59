//! A pixel of a scene: its three vertices, the interpolation, its own shader, and the output merger. And a vertex alone.

use super::moment::{Change, Event, Flags, InputSource, MergeStage, Moment, Quad, Target};
use super::record::{Edit, Input, Invocation, record};
use super::run::{Listing, Run, RunKind};
use crate::exec::Environment;
use crate::isa::WriteMask;
use crate::kernel::{Kernel, Slot};
use crate::raster::{
    Fate, Fragment, Interpolation, LANES, LoneTarget, MergeRecord, PixelBatch, PixelInputs,
    PixelResult, PixelShader, Vertex, vertex_outputs,
};
use crate::scene::{Output, PixelEvent, PixelHistory, PreparedDraw, RenderError, Rendering};
use crate::semantics::saturate;
use std::fmt;

/// One primitive at one pixel of a rendered scene.
#[derive(Clone)]
pub struct PixelSubject<'a> {
    rendering: &'a Rendering<'a>,
    history: PixelHistory,
    event: usize,
}

/// Why there is nothing to debug.
#[derive(Clone, Debug, PartialEq)]
pub enum PixelError {
    /// The pixel lies outside of the picture.
    Outside {
        /// The pixel.
        pixel: [u32; 2],
        /// Width and height of the picture.
        size: [u32; 2],
    },
    /// No primitive covers the pixel: it has the colour that the picture was cleared to.
    Empty {
        /// The pixel.
        pixel: [u32; 2],
    },
    /// No primitive that was asked for covers it; the history has others.
    NotAmong {
        /// The pixel.
        pixel: [u32; 2],
        /// The draws that cover it.
        draws: Vec<String>,
    },
    /// The picture has no such draw.
    NoDraw {
        /// The draws that it has.
        draws: Vec<String>,
    },
    /// The mesh of the draw has not so many vertices.
    NoVertex {
        /// The vertex.
        vertex: u32,
        /// How many there are.
        count: usize,
    },
    /// The scene could not be drawn.
    Render(RenderError),
}

impl fmt::Display for PixelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outside {
                pixel: [x, y],
                size: [w, h],
            } => {
                write!(f, "the pixel {x},{y} is outside of the {w}x{h} picture")
            }
            Self::Empty { pixel: [x, y] } => {
                write!(
                    f,
                    "nothing is drawn at {x},{y}: the pixel has the clear colour"
                )
            }
            Self::NotAmong {
                pixel: [x, y],
                draws,
            } => {
                write!(f, "at {x},{y} that is not drawn, only {}", draws.join(", "))
            }
            Self::NoDraw { draws } => write!(f, "the picture has the draws {}", draws.join(", ")),
            Self::NoVertex { vertex, count } => {
                write!(
                    f,
                    "the mesh has the vertices 0 to {}, not {vertex}",
                    count.saturating_sub(1)
                )
            }
            Self::Render(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for PixelError {}

/// Which of the primitives at a pixel is meant.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Which {
    /// The draw by its name; without one all of them.
    pub draw: Option<String>,
    /// The primitive of the draw; without one all of them.
    pub primitive: Option<usize>,
}

impl<'a> PixelSubject<'a> {
    /// The last primitive that was written to the pixel, or else the last one that covers it; of those that are meant.
    ///
    /// # Errors
    /// [`PixelError`].
    pub fn new(
        rendering: &'a Rendering<'a>,
        pixel: [u32; 2],
        which: &Which,
    ) -> Result<Self, PixelError> {
        let size = rendering.size();
        if pixel[0] >= size[0] || pixel[1] >= size[1] {
            return Err(PixelError::Outside { pixel, size });
        }
        let history = rendering
            .history(Output::Picture, pixel)
            .map_err(PixelError::Render)?;
        let name = |event: &PixelEvent| {
            draws(rendering)
                .get(event.draw)
                .map_or("", |draw| draw.name)
        };
        let meant = |(_, event): &(usize, &PixelEvent)| {
            which
                .draw
                .as_deref()
                .is_none_or(|wanted| wanted == name(event))
                && which
                    .primitive
                    .is_none_or(|wanted| wanted == event.fragment.primitive)
        };
        let found: Vec<_> = history.events.iter().enumerate().filter(meant).collect();
        let written = found
            .iter()
            .rfind(|(_, event)| event.merge.fate() == Fate::Written);
        let event = match written.or(found.last()) {
            Some((event, _)) => *event,
            None if history.events.is_empty() => return Err(PixelError::Empty { pixel }),
            None => {
                let mut draws: Vec<_> = history.events.iter().map(|e| name(e).to_owned()).collect();
                draws.dedup();
                return Err(PixelError::NotAmong { pixel, draws });
            }
        };
        Ok(Self {
            rendering,
            history,
            event,
        })
    }

    /// Another primitive of the history.
    pub fn with_event(&self, event: usize) -> Option<Self> {
        (event < self.history.events.len()).then(|| Self {
            event,
            ..self.clone()
        })
    }

    /// The scene as it was rendered.
    pub fn rendering(&self) -> &'a Rendering<'a> {
        self.rendering
    }

    /// Everything that covers the pixel.
    pub fn history(&self) -> &PixelHistory {
        &self.history
    }

    /// Which event of the history is debugged.
    pub fn event(&self) -> usize {
        self.event
    }

    /// The draw that is debugged.
    pub fn draw(&self) -> Option<&'a PreparedDraw<'a>> {
        draws(self.rendering).get(self.history.events.get(self.event)?.draw)
    }

    pub(super) fn record(&self, edits: &[Edit]) -> Vec<Run<'a>> {
        let Some(event) = self.history.events.get(self.event) else {
            return Vec::new();
        };
        let Some(shaded) = self.rendering.shaded(Output::Picture, event.draw) else {
            return Vec::new();
        };
        let draw = shaded.draw();
        let of = |run: usize| -> Vec<Edit> {
            edits
                .iter()
                .filter(|edit| edit.run == run)
                .copied()
                .collect()
        };
        let interpolation = &event.fragment.interpolation;
        // A point has one vertex, a line two.
        let mut vertices: Vec<u32> = Vec::new();
        for vertex in interpolation
            .vertices
            .iter()
            .chain(&interpolation.provoking)
        {
            if !vertices.contains(vertex) {
                vertices.push(*vertex);
            }
        }
        let mut runs: Vec<Run<'a>> = (vertices.iter().enumerate())
            .map(|(number, vertex)| {
                let corner = interpolation.vertices.iter().position(|v| v == vertex);
                vertex_run(self.rendering, draw, *vertex, corner, &of(number))
            })
            .collect();
        let outputs: Vec<Vertex> = runs.iter().map(output).collect();
        let output = |vertex: u32| {
            let place = vertices.iter().position(|v| *v == vertex);
            place
                .and_then(|place| outputs.get(place))
                .copied()
                .unwrap_or_default()
        };
        let inputs = Inputs {
            corners: interpolation.vertices.map(output),
            flat: interpolation.provoking.map(output),
            interpolation,
        };
        let mut run = record(
            Invocation {
                kind: RunKind::Pixel {
                    pixel: self.history.pixel,
                },
                listing: listing(self.rendering, draw, false),
                environment: shaded.environment().clone(),
                lane: event.fragment.lane,
                helpers: event.fragment.helpers(),
                inputs: inputs.of(&draw.pixel.kernel),
            },
            &of(runs.len()),
        );
        let fragment = Fragment {
            batch: inputs.batch(&event.fragment.batch),
            ..event.fragment.clone()
        };
        if let Some(merge) = merged(&self.history, draw, event, &fragment, &run) {
            tell_merge(&mut run, &merge);
        }
        runs.push(run);
        runs
    }
}

impl fmt::Debug for PixelSubject<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { history, event, .. } = self;
        f.debug_struct("PixelSubject")
            .field("history", history)
            .field("event", event)
            .finish_non_exhaustive()
    }
}

/// One vertex of a draw of a rendered scene.
#[derive(Clone)]
pub struct VertexSubject<'a> {
    rendering: &'a Rendering<'a>,
    draw: &'a PreparedDraw<'a>,
    vertex: u32,
}

impl<'a> VertexSubject<'a> {
    /// A vertex, by its number in the mesh, of a draw of the picture; without a name of the last one.
    ///
    /// # Errors
    /// [`PixelError`].
    pub fn new(
        rendering: &'a Rendering<'a>,
        vertex: u32,
        draw: Option<&str>,
    ) -> Result<Self, PixelError> {
        let all = draws(rendering);
        let found = match draw {
            Some(name) => all.iter().rfind(|draw| draw.name == name),
            None => all.last(),
        };
        let draw = found.ok_or_else(|| PixelError::NoDraw {
            draws: all.iter().map(|draw| draw.name.to_owned()).collect(),
        })?;
        let count = draw.mesh.vertex_count();
        if vertex as usize >= count {
            return Err(PixelError::NoVertex { vertex, count });
        }
        Ok(Self {
            rendering,
            draw,
            vertex,
        })
    }

    /// The scene as it was rendered.
    pub fn rendering(&self) -> &'a Rendering<'a> {
        self.rendering
    }

    /// The draw.
    pub fn draw(&self) -> &'a PreparedDraw<'a> {
        self.draw
    }

    /// The vertex.
    pub fn vertex(&self) -> u32 {
        self.vertex
    }

    pub(super) fn record(&self, edits: &[Edit]) -> Vec<Run<'a>> {
        vec![vertex_run(
            self.rendering,
            self.draw,
            self.vertex,
            None,
            edits,
        )]
    }
}

impl fmt::Debug for VertexSubject<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (draw, vertex) = (self.draw.name, self.vertex);
        f.debug_struct("VertexSubject")
            .field("draw", &draw)
            .field("vertex", &vertex)
            .finish_non_exhaustive()
    }
}

/// The draws of the picture.
fn draws<'a>(rendering: &'a Rendering<'a>) -> &'a [PreparedDraw<'a>] {
    rendering
        .pass(Output::Picture)
        .map_or(&[], |pass| &pass.draws)
}

fn listing<'a>(
    rendering: &'a Rendering<'a>,
    draw: &'a PreparedDraw<'a>,
    vertex: bool,
) -> Listing<'a> {
    let shader = if vertex { draw.vertex } else { draw.pixel };
    Listing {
        program: &shader.program,
        kernel: &shader.kernel,
        sources: rendering.scene().sources(),
    }
}

/// The vertex shader, for one vertex. What it leaves is taken into range at the end, as the rasterizer does it.
fn vertex_run<'a>(
    rendering: &'a Rendering<'a>,
    draw: &'a PreparedDraw<'a>,
    vertex: u32,
    corner: Option<usize>,
    edits: &[Edit],
) -> Run<'a> {
    let kernel = &draw.vertex.kernel;
    let inputs =
        (draw.inputs(vertex as usize).into_iter().enumerate()).filter_map(|(register, value)| {
            let slot = Slot::input(register).filter(|slot| !kernel.read(*slot).is_empty())?;
            let value: Quad = [value; 4];
            Some(Input {
                slot,
                source: InputSource::Fetched,
                raw: value,
                value,
            })
        });
    let environment: Environment<'a> = draw.vertex_environment();
    let mut run = record(
        Invocation {
            kind: RunKind::Vertex { corner, vertex },
            listing: listing(rendering, draw, true),
            environment,
            lane: 0,
            helpers: [false; 4],
            inputs: inputs.collect(),
        },
        edits,
    );
    let registers = run.registers(usize::MAX);
    let outputs = (0..).map_while(Slot::color_output).chain([Slot::FOG]);
    for slot in outputs.filter(|slot| !kernel.written(*slot).is_empty()) {
        let value = registers.quad(slot);
        run.moments
            .extend(taken(slot, kernel.written(slot), value, Event::Taken));
    }
    run
}

/// A moment that takes components of a register into 0 to 1; none if they are.
fn taken(slot: Slot, mask: WriteMask, before: Quad, event: Event) -> Option<Moment> {
    let mut after = before;
    let mut flags = [Flags::default(); 4];
    for (pixel, flags) in after.iter_mut().zip(&mut flags) {
        for c in mask.components() {
            let value = saturate(pixel[c]);
            if value != pixel[c] {
                flags.clamped = flags.clamped.or(WriteMask::component(c));
            }
            pixel[c] = value;
        }
    }
    let change = Change {
        target: Target::Slot(slot),
        mask,
        before,
        after,
        first: WriteMask::NONE,
    };
    let changed = flags.iter().any(|flags| !flags.is_empty());
    changed.then(|| Moment {
        instruction: None,
        event,
        change: Some(change),
        flags,
        lost: Vec::new(),
    })
}

/// What a recorded vertex leaves to the rasterizer.
fn output(run: &Run<'_>) -> Vertex {
    let registers = run.registers(usize::MAX);
    vertex_outputs(run.listing.kernel, |slot| registers.slot(slot, 0))
}

/// The interpolation, from recorded vertices.
struct Inputs<'i> {
    corners: [Vertex; 3],
    /// The vertex that gives the colours, under flat shading.
    flat: Option<Vertex>,
    interpolation: &'i Interpolation,
}

impl Inputs<'_> {
    /// a0 + s1·(a1 − a0) + s2·(a2 − a0) at a pixel of the quad, as the rasterizer has it.
    fn mix(&self, ends: [f32; 3], pixel: usize) -> f32 {
        let [a0, a1, a2] = ends;
        let [s1, s2] = self.interpolation.shares;
        a0 + s1[pixel] * (a1 - a0) + s2[pixel] * (a2 - a0)
    }

    fn mixed(&self, corners: [[f32; 4]; 3], finish: fn(f32) -> f32) -> (InputSource, Quad) {
        let value = std::array::from_fn(|pixel| {
            std::array::from_fn(|c| finish(self.mix(corners.map(|corner| corner[c]), pixel)))
        });
        let [s1, s2] = self.interpolation.shares;
        let shares = std::array::from_fn(|pixel| [s1[pixel], s2[pixel]]);
        (InputSource::Interpolated { corners, shares }, value)
    }

    fn color(&self, color: fn(&Vertex) -> [f32; 4]) -> (InputSource, Quad) {
        let corners = match &self.flat {
            Some(vertex) => [color(vertex); 3],
            None => self.corners.each_ref().map(color),
        };
        self.mixed(corners.map(|corner| corner.map(saturate)), saturate)
    }

    fn texcoord(&self, set: usize) -> (InputSource, Quad) {
        if self.interpolation.sprite {
            let [s1, s2] = self.interpolation.shares;
            let value = std::array::from_fn(|pixel| [s1[pixel], s2[pixel], 0.0, 0.0]);
            return (InputSource::Sprite, value);
        }
        let corners = self
            .corners
            .each_ref()
            .map(|vertex| vertex.texcoords[set & 7].to_array());
        self.mixed(corners, |value| value)
    }

    /// The inputs that a pixel shader reads.
    fn of(&self, kernel: &Kernel) -> Vec<Input> {
        let colors = [
            self.color(|vertex| vertex.diffuse.to_array()),
            self.color(|vertex| vertex.specular.to_array()),
        ];
        let colors = colors
            .into_iter()
            .enumerate()
            .map(|(i, color)| (Slot::input(i), color));
        let sets = (0..8).map(|set| (Slot::texcoord(set), self.texcoord(set)));
        colors
            .chain(sets)
            .filter_map(|(slot, (source, value))| {
                let slot = slot.filter(|slot| !kernel.read(*slot).is_empty())?;
                Some(Input {
                    slot,
                    source,
                    raw: value,
                    value,
                })
            })
            .collect()
    }

    /// The batch of the fragment, with the fog of these vertices: what the merger reads of them.
    fn batch(&self, batch: &PixelBatch) -> Box<PixelBatch> {
        let mut batch = Box::new(batch.clone());
        // NaN is clear.
        let unit = |fog: f32| if fog < 1.0 { saturate(fog) } else { 1.0 };
        let ends = self.corners.each_ref().map(|vertex| unit(vertex.fog));
        for (pixel, fog) in batch.fog.iter_mut().enumerate().take(4) {
            *fog = saturate(self.mix(ends, pixel));
        }
        batch
    }
}

/// A pixel shader that has run: what the recording left.
struct Recorded {
    result: PixelResult,
    writes_depth: bool,
}

impl PixelShader for Recorded {
    fn inputs(&self) -> PixelInputs {
        PixelInputs::ALL
    }

    fn shade(&self, _: &PixelBatch, out: &mut PixelResult) {
        out.clone_from(&self.result);
    }

    fn writes_depth(&self) -> bool {
        self.writes_depth
    }
}

/// The way of a recorded pixel through the merger.
fn merged(
    history: &PixelHistory,
    draw: &PreparedDraw<'_>,
    event: &PixelEvent,
    fragment: &Fragment,
    run: &Run<'_>,
) -> Option<MergeRecord> {
    let registers = run.registers(usize::MAX);
    let mut result = PixelResult::new();
    for lane in 0..4.min(LANES) {
        let color = registers.slot(Slot::R0, lane);
        for (component, value) in result.color.iter_mut().zip(color) {
            component[lane] = value;
        }
        result.killed[lane] = registers.killed()[lane];
        result.depth[lane] = registers.slot(Slot::DEPTH, lane)[0];
    }
    let shader = Recorded {
        result,
        writes_depth: run.listing.kernel.writes_depth(),
    };
    let mut target =
        LoneTarget::new(history.pixel.into(), history.format, event.merge.before).ok()?;
    Some(target.draw(&draw.state, fragment, &shader))
}

/// Appends the stages of the merger to the run of a pixel.
pub(crate) fn tell_merge(run: &mut Run<'_>, merge: &MergeRecord) {
    let event = |stage: MergeStage| Event::Merge(Box::new(stage));
    let plain = |stage: MergeStage| Moment {
        instruction: None,
        event: event(stage),
        change: None,
        flags: Default::default(),
        lost: Vec::new(),
    };
    if merge.killed {
        run.moments.push(plain(MergeStage::Killed));
        return;
    }
    let color = run.registers(usize::MAX).quad(Slot::R0);
    run.moments.extend(taken(
        Slot::R0,
        WriteMask::ALL,
        color,
        event(MergeStage::Clamp),
    ));
    let stages = [
        merge.alpha_test.map(MergeStage::AlphaTest),
        merge.stencil.map(MergeStage::Stencil),
        merge.depth.map(MergeStage::Depth),
        merge.fog.map(MergeStage::Fog),
        merge.blend.map(MergeStage::Blend),
        merge.write.map(|write| MergeStage::Write {
            write,
            before: merge.before,
            after: merge.after,
        }),
    ];
    run.moments.extend(stages.into_iter().flatten().map(plain));
}
