//! What pixel shaders are given and what they give back.

use super::target::IN_BLOCK;
use crate::isa::WriteMask;

/// Pixels that are shaded together. A multiple of 4: lanes 4q to 4q+3 are the quad (x, y), (x+1, y), (x, y+1),
/// (x+1, y+1), with x and y even.
pub const LANES: usize = 64;

/// Quads that are shaded together.
pub(super) const QUADS: usize = LANES / 4;

/// Four components of all lanes, component by component.
pub type Attribute = [[f32; LANES]; 4];

/// The inputs of up to [`LANES`] pixels.
///
/// Lanes from `4 * quads` on hold nothing of meaning, and so do attributes that [`PixelShader::inputs`] leaves out.
#[derive(Debug, Clone, PartialEq)]
// No vector of it lies in two lines of the cache.
#[repr(C, align(64))]
pub struct PixelBatch {
    /// The column of each pixel. A pixel that is not live may lie outside the target.
    pub x: [i32; LANES],
    /// The row of each pixel.
    pub y: [i32; LANES],
    /// `v0`, in 0 to 1.
    pub diffuse: Attribute,
    /// `v1`, in 0 to 1.
    pub specular: Attribute,
    /// `t0` to `t7`, as the vertices had them.
    pub texcoords: [Attribute; 8],
    /// The depth, in 0 to 1.
    pub z: [f32; LANES],
    /// The w of the position.
    pub w: [f32; LANES],
    /// The fog factor of the vertices, in 0 to 1.
    pub fog: [f32; LANES],
    /// Whether the pixel may be written. The others complete quads, for differences between neighbours: their inputs are
    /// those of the primitive's plane continued beyond its edge.
    pub live: [bool; LANES],
    /// How many quads there are, 1 to `LANES / 4`.
    pub quads: usize,
    /// Whether they are those of a block of a tile, in its order.
    pub(super) block: bool,
}

impl PixelBatch {
    /// A batch of no quads.
    pub fn empty() -> Self {
        Self {
            quads: 0,
            block: false,
            x: [0; LANES],
            y: [0; LANES],
            live: [false; LANES],
            diffuse: [[0.0; LANES]; 4],
            specular: [[0.0; LANES]; 4],
            texcoords: [[[0.0; LANES]; 4]; 8],
            z: [0.0; LANES],
            w: [1.0; LANES],
            fog: [1.0; LANES],
        }
    }

    /// Puts a quad in its place: the position of its first pixel, which of its pixels are live (bit i: lane i of the
    /// quad), their depths.
    #[inline(always)]
    pub(super) fn place(&mut self, quad: usize, x: i32, y: i32, live: u8, z: &[f32; 4]) {
        self.x.as_chunks_mut().0[quad] = [x, x + 1, x, x + 1];
        self.y.as_chunks_mut().0[quad] = [y, y, y + 1, y + 1];
        self.live.as_chunks_mut().0[quad] = lanes(live);
        self.z.as_chunks_mut().0[quad] = *z;
    }

    /// Makes it a batch of a block: the position of its first pixel, which of its pixels are live, their depths.
    #[inline(always)]
    pub(super) fn place_block(&mut self, x: i32, y: i32, live: [bool; LANES], z: &[f32; LANES]) {
        let places = [(&mut self.x, x), (&mut self.y, y)]
            .into_iter()
            .zip(IN_BLOCK);
        for ((places, first), offsets) in places {
            for (place, offset) in places.iter_mut().zip(offsets) {
                *place = first + offset;
            }
        }
        self.live = live;
        self.z = *z;
        self.quads = QUADS;
        self.block = true;
    }
}

/// Which of four lanes a mask has: bit i is lane i.
#[inline(always)]
pub(super) const fn lanes(mask: u8) -> [bool; 4] {
    // Looked up: it is asked for every quad.
    const LANES_OF: [[bool; 4]; 16] = {
        let mut all = [[false; 4]; 16];
        let mut mask = 0;
        while mask < 16 {
            all[mask] = [mask & 1 != 0, mask & 2 != 0, mask & 4 != 0, mask & 8 != 0];
            mask += 1;
        }
        all
    };
    LANES_OF[(mask & 0xf) as usize]
}

/// What became of the pixels of a batch. It comes to [`PixelShader::shade`] with nothing killed.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub struct PixelResult {
    /// `r0`. The merger takes it into 0 to 1.
    pub color: Attribute,
    /// Depths that replace the interpolated ones, if [`PixelShader::writes_depth`].
    pub depth: [f32; LANES],
    /// Pixels that `texkill` took out.
    pub killed: [bool; LANES],
    /// What goes into the further planes of a target that was [split](super::Target::split). Those that are missing here
    /// take the colour.
    pub more: Vec<Attribute>,
    /// The planes, the first is 0, into which killed pixels go, too, where they pass the depth and stencil tests. They
    /// change nothing else.
    pub shows_killed: Vec<usize>,
}

impl PixelResult {
    /// A result to be written over: black, nothing killed.
    pub fn new() -> Self {
        Self {
            color: [[0.0; LANES]; 4],
            more: Vec::new(),
            shows_killed: Vec::new(),
            killed: [false; LANES],
            depth: [0.0; LANES],
        }
    }

    /// What goes into a plane of the target.
    #[inline]
    pub(super) fn plane(&self, number: usize) -> &Attribute {
        let further = number.checked_sub(1).and_then(|at| self.more.get(at));
        further.unwrap_or(&self.color)
    }

    /// The same, to be written; none beyond the [planes](Self::planes) that there are.
    pub(super) fn plane_mut(&mut self, number: usize) -> Option<&mut Attribute> {
        match number.checked_sub(1) {
            None => Some(&mut self.color),
            Some(at) => self.more.get_mut(at),
        }
    }

    /// Makes room for so many planes.
    pub(super) fn planes(&mut self, count: usize) {
        self.more.resize(count.saturating_sub(1), [[0.0; LANES]; 4]);
    }
}

impl Default for PixelResult {
    fn default() -> Self {
        Self::new()
    }
}

/// Which components of its inputs a pixel shader reads; the others need not be interpolated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelInputs {
    /// Of `v0`.
    pub diffuse: WriteMask,
    /// Of `v1`.
    pub specular: WriteMask,
    /// Of each coordinate set.
    pub texcoords: [WriteMask; 8],
}

impl PixelInputs {
    /// Everything.
    pub const ALL: Self = Self {
        diffuse: WriteMask::ALL,
        specular: WriteMask::ALL,
        texcoords: [WriteMask::ALL; 8],
    };

    /// Nothing.
    pub const NONE: Self = Self {
        diffuse: WriteMask::NONE,
        specular: WriteMask::NONE,
        texcoords: [WriteMask::NONE; 8],
    };
}

/// The pixel side of a draw call. Pixels must not depend on which others share their batch, quads apart.
pub trait PixelShader: Sync {
    /// What it reads.
    fn inputs(&self) -> PixelInputs;

    /// Shades the lanes below `4 * batch.quads`, those that are not live too.
    fn shade(&self, batch: &PixelBatch, out: &mut PixelResult);

    /// Whether it sets [`PixelResult::depth`]. The depth test then waits for it.
    fn writes_depth(&self) -> bool {
        false
    }

    /// Whether it may set [`PixelResult::killed`]. If not, the depth test need not wait for it.
    fn may_kill(&self) -> bool {
        true
    }
}
