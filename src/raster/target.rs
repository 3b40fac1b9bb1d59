//! What is drawn into: 8-bit colour, depth and stencil.
//!
//! The three lie in square tiles, each on its own, so that cores can draw different tiles without sharing anything.

use std::fmt;

use image::RgbaImage;

use super::names::named;
use super::pixel::{LANES, QUADS};
use super::record::Stored;
use super::state::ColorMask;

/// The side of a tile in pixels. Even, so that no 2×2 quad lies in two tiles.
pub(super) const TILE: u32 = 64;
const TILE_PIXELS: usize = (TILE * TILE) as usize;

/// The side of the blocks that are covered, tested, shaded and stored as a whole where that can be: a batch of pixels.
pub(super) const BLOCK: u32 = 8;
const _: () = assert!((BLOCK * BLOCK) as usize == LANES && TILE.is_multiple_of(BLOCK));

/// Where in its tile a pixel lies. The pixels of a block follow each other, in it those of a quad: upper left, upper right,
/// lower left, lower right.
#[inline(always)]
pub(super) const fn place_in_tile(x: u32, y: u32) -> usize {
    let (x, y) = (x % TILE, y % TILE);
    let block = y / BLOCK * (TILE / BLOCK) + x / BLOCK;
    let quad = y % BLOCK / 2 * (BLOCK / 2) + x % BLOCK / 2;
    (block as usize * QUADS + quad as usize) * 4 + (y % 2 * 2 + x % 2) as usize
}

/// The column and the row of each pixel of a block, counted from its upper left one, in their order.
pub(super) const IN_BLOCK: [[i32; LANES]; 2] = {
    let mut places = [[0; LANES]; 2];
    let mut pixel = 0;
    while pixel < LANES {
        let (x, y) = (pixel as u32 % BLOCK, pixel as u32 / BLOCK);
        let place = place_in_tile(x, y);
        places[0][place] = x as i32;
        places[1][place] = y as i32;
        pixel += 1;
    }
    places
};

named! {
    /// `D3DFORMAT`: what a colour target stores.
    #[derive(Default)]
    ColorFormat, "format of a target" {
        /// Colour and alpha.
        #[default]
        A8R8G8B8 = 21 "a8r8g8b8",
        /// Colour only: the alpha reads 1 and cannot be written.
        X8R8G8B8 = 22 "x8r8g8b8",
    }
}

impl ColorFormat {
    /// A colour as a target of this format holds it.
    pub fn held(self, color: [u8; 4]) -> [u8; 4] {
        match self {
            Self::A8R8G8B8 => color,
            Self::X8R8G8B8 => [color[0], color[1], color[2], 255],
        }
    }

    /// The channels that are written of those of a mask.
    pub fn written(self, mask: ColorMask) -> ColorMask {
        match self {
            Self::A8R8G8B8 => mask,
            Self::X8R8G8B8 => ColorMask::from_bits(mask.bits() & 0b111),
        }
    }
}

/// What a target holds before anything is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// What the colour stores.
    pub format: ColorFormat,
    /// Red, green, blue, alpha, taken into 0 to 1.
    pub color: [f32; 4],
    /// The depth, taken into 0 to 1.
    pub depth: f32,
    /// The stencil value.
    pub stencil: u8,
}

impl Default for Surface {
    /// Transparent black, depth 1, stencil 0.
    fn default() -> Self {
        Self {
            format: ColorFormat::default(),
            color: [0.0; 4],
            depth: 1.0,
            stencil: 0,
        }
    }
}

impl Surface {
    /// The same as the buffers hold it: NaN is 0, halves between two steps of a colour go up.
    pub fn stored(&self) -> Stored {
        let bytes = (self.color).map(|value| (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
        Stored {
            color: self.format.held(bytes),
            depth: super::unit(self.depth),
            stencil: self.stencil,
        }
    }
}

/// A target of a size that this crate refuses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TargetTooLarge {
    /// The width asked for.
    pub width: u32,
    /// The height asked for.
    pub height: u32,
}

impl fmt::Display for TargetTooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a target of {}×{} pixels is too large: at most {} on a side and {} in all",
            self.width,
            self.height,
            Target::MAX_SIDE,
            Target::MAX_PIXELS
        )
    }
}

impl std::error::Error for TargetTooLarge {}

/// More planes than a target of a size can have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooManyPlanes {
    /// How many were asked for.
    pub planes: usize,
    /// The size of the target.
    pub size: [u32; 2],
}

impl fmt::Display for TooManyPlanes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            planes,
            size: [width, height],
        } = self;
        write!(
            f,
            "{planes} pictures of {width}×{height} pixels are too many: at most {} pictures and {} pixels in all",
            Target::MAX_PLANES,
            Target::MAX_PIXELS
        )
    }
}

impl std::error::Error for TooManyPlanes {}

/// One tile; pixels in the order of [`place_in_tile`].
///
/// To clear a tile is only noted down, and done by whoever draws into it first: then it is in the cache of the core that
/// needs it, and what nobody draws into is never touched.
pub(super) struct Tile {
    /// What all pixels hold in truth, whatever stands in the buffers.
    cleared: Option<Stored>,
    pub(super) color: Box<[[u8; 4]]>,
    /// The colours of the further planes.
    pub(super) more: Vec<Box<[[u8; 4]]>>,
    pub(super) depth: Box<[f32]>,
    pub(super) stencil: Box<[u8]>,
}

impl Tile {
    /// A tile that holds this, with one plane.
    fn new(holds: Stored) -> Self {
        // Memory of zeros costs nothing until it is used.
        Self {
            cleared: Some(holds),
            color: vec![[0; 4]; TILE_PIXELS].into_boxed_slice(),
            more: Vec::new(),
            depth: vec![0.0; TILE_PIXELS].into_boxed_slice(),
            stencil: vec![0; TILE_PIXELS].into_boxed_slice(),
        }
    }

    /// The same tile once its buffers hold what it holds. Whoever looks into them needs that.
    pub(super) fn settled(&mut self) -> &mut Self {
        if let Some(holds) = self.cleared.take() {
            self.color.fill(holds.color);
            for plane in &mut self.more {
                plane.fill(holds.color);
            }
            self.depth.fill(holds.depth);
            self.stencil.fill(holds.stencil);
        }
        self
    }

    /// What a pixel holds in a plane; none if there is no such plane, or no such pixel.
    fn color(&self, plane: usize, pixel: usize) -> Option<[u8; 4]> {
        let plane = match plane.checked_sub(1) {
            None => &self.color,
            Some(further) => self.more.get(further)?,
        };
        let stored = plane.get(pixel)?;
        Some(self.cleared.map_or(*stored, |holds| holds.color))
    }
}

/// A colour, depth and stencil buffer of one size. Pixel (0, 0) is the upper left one.
///
/// The colour can be [split](Self::split) into planes: several pictures of what is drawn, of which only a shader that knows
/// of them makes different things. They share depth and stencil.
pub struct Target {
    width: u32,
    height: u32,
    format: ColorFormat,
    tiles: Vec<Tile>,
}

impl Target {
    /// The largest width and height.
    pub const MAX_SIDE: u32 = 16384;
    /// The largest number of pixels, which take 9 bytes each. Sides count as rounded up to whole tiles of 64.
    pub const MAX_PIXELS: u64 = 1 << 26;
    /// The largest number of planes. Together they have at most [`Self::MAX_PIXELS`], 4 bytes each.
    pub const MAX_PLANES: usize = 512;

    /// Whether a target of a size can be [split](Self::split) into so many planes, without making one.
    ///
    /// # Errors
    /// [`TooManyPlanes`] if not.
    pub fn check_planes(size: [u32; 2], planes: usize) -> Result<(), TooManyPlanes> {
        let [across, down] = size.map(|side| u64::from(side.div_ceil(TILE)));
        let pixels = (across * down).saturating_mul((TILE_PIXELS * planes) as u64);
        match planes > Self::MAX_PLANES || (planes > 1 && pixels > Self::MAX_PIXELS) {
            true => Err(TooManyPlanes { planes, size }),
            false => Ok(()),
        }
    }

    /// A target that is transparent black, at depth 1 and stencil 0. A size of 0 is a target without pixels.
    ///
    /// # Errors
    ///
    /// [`TargetTooLarge`] beyond [`Self::MAX_SIDE`] or [`Self::MAX_PIXELS`].
    pub fn new(width: u32, height: u32, format: ColorFormat) -> Result<Self, TargetTooLarge> {
        // Tiles are held whole, so it is their pixels that count.
        let count = u64::from(width.div_ceil(TILE)) * u64::from(height.div_ceil(TILE));
        if width > Self::MAX_SIDE
            || height > Self::MAX_SIDE
            || count * TILE_PIXELS as u64 > Self::MAX_PIXELS
        {
            return Err(TargetTooLarge { width, height });
        }
        let surface = Surface {
            format,
            ..Surface::default()
        };
        let holds = surface.stored();
        let tiles = (0..count).map(|_| Tile::new(holds)).collect();
        Ok(Self {
            width,
            height,
            format,
            tiles,
        })
    }

    /// A target that holds this.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn cleared(width: u32, height: u32, surface: &Surface) -> Result<Self, TargetTooLarge> {
        let mut target = Self::new(width, height, surface.format)?;
        let holds = surface.stored();
        target.clear(Some(holds.color), Some(holds.depth), Some(holds.stencil));
        Ok(target)
    }

    /// The width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// The height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// What the colour buffer stores.
    pub fn format(&self) -> ColorFormat {
        self.format
    }

    /// Sets every pixel of the buffers that are given a value: colour as red, green, blue, alpha; depth taken into 0 to 1
    /// (NaN is 0); stencil.
    pub fn clear(&mut self, color: Option<[u8; 4]>, depth: Option<f32>, stencil: Option<u8>) {
        let color = color.map(|color| self.format.held(color));
        let depth = depth.map(super::unit);
        for tile in &mut self.tiles {
            if let (Some(color), Some(depth), Some(stencil)) = (color, depth, stencil) {
                tile.cleared = Some(Stored {
                    color,
                    depth,
                    stencil,
                });
                continue;
            }
            let tile = tile.settled();
            if let Some(color) = color {
                tile.color.fill(color);
                tile.more.iter_mut().for_each(|plane| plane.fill(color));
            }
            if let Some(depth) = depth {
                tile.depth.fill(depth);
            }
            if let Some(stencil) = stencil {
                tile.stencil.fill(stencil);
            }
        }
    }

    /// Red, green, blue and alpha of a pixel; `None` outside.
    pub fn color(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        let (tile, pixel) = self.locate(x, y)?;
        tile.color(0, pixel)
    }

    /// The depth of a pixel, 0 to 1; `None` outside.
    pub fn depth(&self, x: u32, y: u32) -> Option<f32> {
        let (tile, pixel) = self.locate(x, y)?;
        let stored = tile.depth.get(pixel)?;
        Some(tile.cleared.map_or(*stored, |holds| holds.depth))
    }

    /// The stencil value of a pixel; `None` outside.
    pub fn stencil(&self, x: u32, y: u32) -> Option<u8> {
        let (tile, pixel) = self.locate(x, y)?;
        let stored = tile.stencil.get(pixel)?;
        Some(tile.cleared.map_or(*stored, |holds| holds.stencil))
    }

    /// Whether a pixel lies inside a triangle, together with its neighbours to the left and right, above and below: depth
    /// is a plane over the screen there. Where it is not, an edge passes, and which side of it a pixel is on is decided
    /// by rounding that no two rasterizers share.
    ///
    /// Pixels at the border of the target are judged by the three that are nearest to the border. Edges between triangles
    /// of one plane are none, and so are those of draws that do not write depth: such pixels count as inside. Outside of
    /// the target, and across a target of less than 3 pixels, nothing is inside.
    pub fn inside(&self, x: u32, y: u32) -> bool {
        let depth = |x: u32, y: u32| self.depth(x, y).map(f64::from);
        let flat = |depths: [Option<f64>; 3]| {
            let [Some(before), Some(at), Some(after)] = depths else {
                return false;
            };
            // Each of the three is rounded by up to 2⁻²⁵, as floats below 1 are, the middle one counts twice: 1.2e-7. The
            // rest is room for planes that are evaluated in other places.
            (before - 2.0 * at + after).abs() < 2e-7
        };
        let around = |at: u32, side: u32| {
            let middle = at.clamp(1, side.saturating_sub(2).max(1));
            [middle - 1, middle, middle + 1]
        };
        self.depth(x, y).is_some()
            && flat(around(x, self.width).map(|x| depth(x, y)))
            && flat(around(y, self.height).map(|y| depth(x, y)))
    }

    /// Splits the colour into so many planes, which all hold what was drawn so far. What is drawn from now on goes into
    /// each of them: what [`PixelResult::more`](super::PixelResult::more) has for it, or else the colour.
    ///
    /// # Errors
    /// [`TooManyPlanes`] beyond [`Self::MAX_PLANES`], and beyond [`Self::MAX_PIXELS`] in all of them; nothing changes then.
    pub fn split(&mut self, planes: usize) -> Result<(), TooManyPlanes> {
        Self::check_planes([self.width, self.height], planes)?;
        for tile in &mut self.tiles {
            tile.more = vec![tile.color.clone(); planes.saturating_sub(1)];
        }
        Ok(())
    }

    /// The colours as a picture: of the first plane if there are several.
    pub fn to_image(&self) -> RgbaImage {
        self.plane(0)
    }

    /// The colours of a plane as a picture; of a plane that there is not, black.
    pub fn plane(&self, number: usize) -> RgbaImage {
        let mut picture = RgbaImage::new(self.width, self.height);
        let across = self.tiles_across() as usize;
        let row_bytes = 4 * self.width as usize;
        // A picture without columns has no rows either.
        let rows = picture.chunks_exact_mut(row_bytes.max(1));
        for (y, row) in (0..self.height).zip(rows) {
            let tiles = self.tiles.iter().skip((y / TILE) as usize * across);
            for (tile, pixels) in tiles.zip(row.chunks_mut(4 * TILE as usize)) {
                for (x, pixel) in (0..).zip(pixels.as_chunks_mut().0) {
                    if let Some(stored) = tile.color(number, place_in_tile(x, y)) {
                        *pixel = stored;
                    }
                }
            }
        }
        picture
    }

    fn locate(&self, x: u32, y: u32) -> Option<(&Tile, usize)> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let tile = y / TILE * self.tiles_across() + x / TILE;
        Some((self.tiles.get(tile as usize)?, place_in_tile(x, y)))
    }

    /// How many tiles lie side by side.
    pub(super) fn tiles_across(&self) -> u32 {
        self.width.div_ceil(TILE)
    }

    /// The tiles, row by row, before they are [settled](Tile::settled).
    pub(super) fn tiles_mut(&mut self) -> &mut [Tile] {
        &mut self.tiles
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_of_every_tile_are_found() {
        let mut target = Target::new(130, 65, ColorFormat::A8R8G8B8).unwrap();
        assert_eq!(target.color(129, 64), Some([0; 4]));
        assert_eq!(target.depth(0, 64), Some(1.0));
        assert_eq!(target.color(130, 0), None);
        assert_eq!(target.stencil(0, 65), None);
        target.clear(Some([1, 2, 3, 4]), Some(f32::NAN), Some(9));
        assert_eq!(target.color(64, 64), Some([1, 2, 3, 4]));
        assert_eq!(target.depth(64, 64), Some(0.0));
        assert_eq!(target.stencil(64, 64), Some(9));
        assert_eq!(target.to_image().dimensions(), (130, 65));
    }

    #[test]
    fn blocks_follow_each_other_and_quads_in_them() {
        // By hand: the second quad of the second row of quads, in the third block of the second row of blocks.
        assert_eq!(
            place_in_tile(64 + 16 + 2, 8 + 2),
            (8 + 2) * 64 + (4 + 1) * 4
        );
        assert_eq!(place_in_tile(63, 63), 4095);
        assert_eq!((IN_BLOCK[0][22], IN_BLOCK[1][22]), (2, 3));
        let mut places: Vec<_> = (0..TILE * TILE)
            .map(|at| place_in_tile(at % TILE, at / TILE))
            .collect();
        places.sort_unstable();
        assert!(places.into_iter().eq(0..TILE_PIXELS));
    }

    #[test]
    fn buffers_are_cleared_one_by_one() {
        let mut target = Target::new(2, 1, ColorFormat::A8R8G8B8).unwrap();
        target.clear(Some([1, 2, 3, 4]), Some(0.5), Some(9));
        target.clear(None, Some(0.25), None);
        let holds =
            |target: &Target| (target.color(1, 0), target.depth(1, 0), target.stencil(1, 0));
        assert_eq!(holds(&target), (Some([1, 2, 3, 4]), Some(0.25), Some(9)));
        target.clear(Some([5; 4]), None, Some(7));
        assert_eq!(holds(&target), (Some([5; 4]), Some(0.25), Some(7)));
        assert_eq!(target.to_image().get_pixel(1, 0).0, [5; 4]);
    }

    /// A slope over the whole, and a step of 1/8 between columns 4 and 5.
    #[test]
    fn what_is_inside() {
        let mut target = Target::new(9, 4, ColorFormat::A8R8G8B8).unwrap();
        target.tiles[0].settled();
        for (x, y) in (0..TILE * TILE).map(|at| (at % TILE, at / TILE)) {
            let step = if x > 4 { 0.125 } else { 0.0 };
            let depth = 0.25 + x as f32 / 64.0 + y as f32 / 128.0 + step;
            target.tiles[0].depth[place_in_tile(x, y)] = depth;
        }
        for y in 0..4 {
            let inside: Vec<u32> = (0..9).filter(|x| target.inside(*x, y)).collect();
            assert_eq!(inside, [0, 1, 2, 3, 6, 7, 8]);
        }
        assert!(!target.inside(9, 0) && !target.inside(0, 4));
        let narrow = Target::new(2, 4, ColorFormat::A8R8G8B8).unwrap();
        assert!(!narrow.inside(0, 1));
    }

    #[test]
    fn planes_begin_with_what_was_drawn() {
        let mut target = Target::new(130, 65, ColorFormat::A8R8G8B8).unwrap();
        target.clear(Some([1, 2, 3, 4]), None, None);
        target.split(3).unwrap();
        for plane in 0..3 {
            assert_eq!(target.plane(plane).get_pixel(129, 64).0, [1, 2, 3, 4]);
        }
        assert_eq!(target.plane(3).get_pixel(0, 0).0, [0; 4]);
        target.clear(Some([9; 4]), None, None);
        assert_eq!(target.plane(2).get_pixel(64, 0).0, [9; 4]);
        // 3×2 tiles of 4096 pixels: 2²⁶ / 24576 = 2730 would fit, but 512 are the most.
        assert!(target.split(512).is_ok() && target.split(513).is_err());
        let mut large = Target::new(1024, 1024, ColorFormat::A8R8G8B8).unwrap();
        let refused = large.split(65).unwrap_err().to_string();
        assert!(refused.contains("65 pictures of 1024×1024"), "{refused}");
        assert!(large.tiles[0].more.is_empty());
    }

    #[test]
    fn without_alpha_it_reads_one() {
        let mut target = Target::new(1, 1, ColorFormat::X8R8G8B8).unwrap();
        assert_eq!(target.color(0, 0), Some([0, 0, 0, 255]));
        target.clear(Some([7, 7, 7, 7]), None, None);
        assert_eq!(target.color(0, 0), Some([7, 7, 7, 255]));
    }

    #[test]
    fn sizes_of_nothing_and_of_too_much() {
        assert_eq!(
            Target::new(0, 7, ColorFormat::A8R8G8B8)
                .unwrap()
                .to_image()
                .dimensions(),
            (0, 7)
        );
        assert!(Target::new(u32::MAX, 1, ColorFormat::A8R8G8B8).is_err());
        assert!(Target::new(16384, 16384, ColorFormat::A8R8G8B8).is_err());
        assert!(Target::new(u32::MAX, u32::MAX, ColorFormat::A8R8G8B8).is_err());
    }
}
