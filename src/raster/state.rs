//! The render states of Direct3D 8 that lie around the shaders, with the defaults of the runtime.

use glam::Vec4;

use super::names::named;

named! {
    /// `D3DRS_CULLMODE`: which triangles are left out, by their winding on the screen (y downwards).
    #[derive(Default)]
    CullMode, "cull mode" {
        /// Both sides are drawn.
        None = 1 "none",
        /// Clockwise triangles are left out.
        Cw = 2 "cw",
        /// Counter-clockwise triangles are left out.
        #[default]
        Ccw = 3 "ccw",
    }
}

named! {
    /// `D3DRS_SHADEMODE`: where the two colours of a pixel come from. Texture coordinates are always interpolated.
    #[derive(Default)]
    ShadeMode, "shade mode" {
        /// From the first vertex of the primitive.
        Flat = 1 "flat",
        /// Interpolated between the vertices.
        #[default]
        Gouraud = 2 "gouraud",
    }
}

named! {
    /// `D3DRS_FILLMODE`: what is drawn of a triangle.
    #[derive(Default)]
    FillMode, "fill mode" {
        /// Its corners, as points of the state's size.
        Point = 1 "point",
        /// Its edges.
        Wireframe = 2 "wireframe",
        /// Its area.
        #[default]
        Solid = 3 "solid",
    }
}

named! {
    /// The comparison of the depth, alpha and stencil tests. The new value stands on the left.
    Compare, "comparison" {
        /// Never passes.
        Never = 1 "never",
        /// Passes if the new value is smaller.
        Less = 2 "less",
        /// Passes if both are equal.
        Equal = 3 "equal",
        /// Passes if the new value is smaller or equal.
        LessEqual = 4 "lessequal",
        /// Passes if the new value is greater.
        Greater = 5 "greater",
        /// Passes if the two differ.
        NotEqual = 6 "notequal",
        /// Passes if the new value is greater or equal.
        GreaterEqual = 7 "greaterequal",
        /// Always passes.
        Always = 8 "always",
    }
}

impl Compare {
    /// Whether `new` passes against `reference`.
    #[inline]
    pub fn passes<T: PartialOrd>(self, new: T, reference: T) -> bool {
        match self {
            Self::Never => false,
            Self::Less => new < reference,
            Self::Equal => new == reference,
            Self::LessEqual => new <= reference,
            Self::Greater => new > reference,
            Self::NotEqual => new != reference,
            Self::GreaterEqual => new >= reference,
            Self::Always => true,
        }
    }
}

named! {
    /// `D3DRS_SRCBLEND` and `D3DRS_DESTBLEND`: what a colour is multiplied by before the two are joined.
    BlendFactor, "blend factor" {
        /// 0.
        Zero = 1 "zero",
        /// 1.
        One = 2 "one",
        /// The source colour; its alpha for alpha.
        SrcColor = 3 "srccolor",
        /// 1 less the source colour.
        InvSrcColor = 4 "invsrccolor",
        /// The source alpha.
        SrcAlpha = 5 "srcalpha",
        /// 1 less the source alpha.
        InvSrcAlpha = 6 "invsrcalpha",
        /// The alpha of the target.
        DestAlpha = 7 "destalpha",
        /// 1 less the alpha of the target.
        InvDestAlpha = 8 "invdestalpha",
        /// The colour of the target; its alpha for alpha.
        DestColor = 9 "destcolor",
        /// 1 less the colour of the target.
        InvDestColor = 10 "invdestcolor",
        /// The smaller of the source alpha and 1 less the target's; 1 for alpha.
        SrcAlphaSat = 11 "srcalphasat",
        /// As source factor only: the source alpha here and its complement for the target, whatever that one's factor says.
        BothSrcAlpha = 12 "bothsrcalpha",
        /// As source factor only: the complement of the source alpha here, and the source alpha for the target.
        BothInvSrcAlpha = 13 "bothinvsrcalpha",
    }
}

named! {
    /// `D3DRS_BLENDOP`: how the two products are joined.
    BlendOp, "blend operation" {
        /// Source plus target.
        Add = 1 "add",
        /// Source less target.
        Subtract = 2 "subtract",
        /// Target less source.
        RevSubtract = 3 "revsubtract",
        /// The smaller of the two colours, without the factors.
        Min = 4 "min",
        /// The greater of the two colours, without the factors.
        Max = 5 "max",
    }
}

named! {
    /// `D3DRS_FOGTABLEMODE`: how the fog of a pixel follows from its distance.
    FogMode, "fog mode" {
        /// No table: the factor is the vertex output `oFog`, interpolated.
        None = 0 "none",
        /// e to the power of -(distance · density).
        Exp = 1 "exp",
        /// e to the power of -(distance · density)².
        Exp2 = 2 "exp2",
        /// (end - distance) / (end - start).
        Linear = 3 "linear",
    }
}

named! {
    /// The distance that table fog uses. Direct3D 8 decides by the projection matrix: the depth if its fourth column is
    /// (0,0,0,1), else w.
    FogDistance, "fog distance" {
        /// The depth as the depth buffer holds it, 0 to 1.
        Z = 0 "z",
        /// The w of the position, which a perspective projection makes the distance from the eye.
        W = 1 "w",
    }
}

named! {
    /// `D3DRS_STENCILFAIL`, `…ZFAIL` and `…PASS`: what becomes of the stencil value.
    StencilOp, "stencil operation" {
        /// It stays.
        Keep = 1 "keep",
        /// 0.
        Zero = 2 "zero",
        /// The reference value.
        Replace = 3 "replace",
        /// One more, at most 255.
        IncrSat = 4 "incrsat",
        /// One less, at least 0.
        DecrSat = 5 "decrsat",
        /// Every bit turned over.
        Invert = 6 "invert",
        /// One more; 0 after 255.
        Incr = 7 "incr",
        /// One less; 255 after 0.
        Decr = 8 "decr",
    }
}

/// The depth test (`D3DRS_ZENABLE`, `ZWRITEENABLE`, `ZFUNC`, `ZBIAS`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthState {
    /// Without it every pixel passes and no depth is written.
    pub enable: bool,
    /// Whether pixels that pass leave their depth behind.
    pub write: bool,
    /// New depth against the stored one.
    pub func: Compare,
    /// 0 to 16 steps of 1/65535 towards the eye.
    pub bias: u8,
}

impl Default for DepthState {
    fn default() -> Self {
        Self {
            enable: true,
            write: true,
            func: Compare::LessEqual,
            bias: 0,
        }
    }
}

/// The alpha test (`D3DRS_ALPHATESTENABLE`, `ALPHAREF`, `ALPHAFUNC`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AlphaTest {
    /// Whether pixels are tested at all.
    pub enable: bool,
    /// 0 to 255, compared with the alpha rounded to 8 bits.
    pub reference: u8,
    /// Alpha of the pixel against the reference.
    pub func: Compare,
}

impl Default for AlphaTest {
    fn default() -> Self {
        Self {
            enable: false,
            reference: 0,
            func: Compare::Always,
        }
    }
}

/// Blending (`D3DRS_ALPHABLENDENABLE`, `SRCBLEND`, `DESTBLEND`, `BLENDOP`); one set for colour and alpha.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlendState {
    /// Without it the pixel replaces what was there.
    pub enable: bool,
    /// The factor of the new colour.
    pub source: BlendFactor,
    /// The factor of the colour in the target.
    pub destination: BlendFactor,
    /// How the two are joined.
    pub op: BlendOp,
}

impl Default for BlendState {
    fn default() -> Self {
        Self {
            enable: false,
            source: BlendFactor::One,
            destination: BlendFactor::Zero,
            op: BlendOp::Add,
        }
    }
}

/// Fog (`D3DRS_FOGENABLE` and its neighbours). It changes red, green and blue, never alpha.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FogState {
    /// Whether there is fog.
    pub enable: bool,
    /// The colour of full fog, 0 to 1.
    pub color: [f32; 3],
    /// [`FogMode::None`]: the vertices say how much; else the distance does, and what the vertices say is ignored.
    pub table: FogMode,
    /// The distance of table fog.
    pub distance: FogDistance,
    /// Where linear fog begins.
    pub start: f32,
    /// Where linear fog is complete.
    pub end: f32,
    /// The density of the exponential modes.
    pub density: f32,
}

impl Default for FogState {
    fn default() -> Self {
        Self {
            enable: false,
            color: [0.0; 3],
            table: FogMode::None,
            distance: FogDistance::Z,
            start: 0.0,
            end: 1.0,
            density: 1.0,
        }
    }
}

/// The stencil test (`D3DRS_STENCIL…`), on 8 bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StencilState {
    /// Whether there is a stencil test.
    pub enable: bool,
    /// `reference & mask` against `stored & mask`.
    pub func: Compare,
    /// The reference value.
    pub reference: u8,
    /// The bits that are compared.
    pub mask: u8,
    /// The bits that are written.
    pub write_mask: u8,
    /// What is done when the stencil test fails.
    pub fail: StencilOp,
    /// What is done when the stencil test passes and the depth test fails.
    pub depth_fail: StencilOp,
    /// What is done when both pass.
    pub pass: StencilOp,
}

impl Default for StencilState {
    fn default() -> Self {
        Self {
            enable: false,
            func: Compare::Always,
            reference: 0,
            mask: 0xff,
            write_mask: 0xff,
            fail: StencilOp::Keep,
            depth_fail: StencilOp::Keep,
            pass: StencilOp::Keep,
        }
    }
}

/// Points (`D3DRS_POINTSIZE` and its neighbours). `D3DRS_POINTSCALEENABLE` is missing because Direct3D 8 ignores it when a
/// vertex shader runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointState {
    /// The side of a point in pixels where the vertex does not say.
    pub size: f32,
    /// No point is smaller.
    pub min: f32,
    /// No point is larger.
    pub max: f32,
    /// `D3DRS_POINTSPRITEENABLE`: every coordinate set becomes (u, v, 0, 0), 0 to 1 across the point.
    pub sprite: bool,
}

impl Default for PointState {
    fn default() -> Self {
        Self {
            size: 1.0,
            min: 0.0,
            max: 64.0,
            sprite: false,
        }
    }
}

/// `D3DRS_COLORWRITEENABLE`: the channels of the target that are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ColorMask(u8);

impl ColorMask {
    /// All four channels, the default.
    pub const ALL: Self = Self(0xf);

    /// From the bits of Direct3D: 1 red, 2 green, 4 blue, 8 alpha. Higher bits are ignored.
    pub fn from_bits(bits: u8) -> Self {
        Self(bits & 0xf)
    }

    /// The bits of Direct3D.
    pub fn bits(self) -> u8 {
        self.0
    }

    /// Whether channel 0 (red) to 3 (alpha) is written.
    #[inline]
    pub fn writes(self, channel: usize) -> bool {
        channel < 4 && self.0 >> channel & 1 == 1
    }
}

impl Default for ColorMask {
    fn default() -> Self {
        Self::ALL
    }
}

/// Everything around the shaders that a draw call depends on. The default is that of Direct3D 8.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RenderState {
    /// Which winding is left out.
    pub cull: CullMode,
    /// Colours of the first vertex, or interpolated.
    pub shade: ShadeMode,
    /// Areas, edges or corners of triangles.
    pub fill: FillMode,
    /// The depth test.
    pub depth: DepthState,
    /// The alpha test.
    pub alpha_test: AlphaTest,
    /// Blending with what the target holds.
    pub blend: BlendState,
    /// The channels that are written.
    pub color_mask: ColorMask,
    /// Fog.
    pub fog: FogState,
    /// The stencil test.
    pub stencil: StencilState,
    /// The size of points.
    pub point: PointState,
    /// User clip planes that are on: what has a dot product with the clip-space position of at least 0 is kept.
    pub clip_planes: [Option<Vec4>; 6],
    /// The part of the target that is drawn into, and its depths.
    pub viewport: ViewportState,
}

impl RenderState {
    /// What the depth of a position, its z over its w, is multiplied by, and what is added then: the depths of the viewport
    /// and the steps of the bias. The result is taken into 0 to 1. A depth that a shader sets knows neither.
    pub fn depth_mapping(&self) -> [f32; 2] {
        let [min_z, max_z] = [self.viewport.min_z, self.viewport.max_z].map(super::unit);
        let bias = f64::from(self.depth.bias) * DEPTH_BIAS_STEP;
        [max_z - min_z, (f64::from(min_z) - bias) as f32]
    }

    /// The depth at a position, 0 to 1, from its z over its w, which is taken into 0 to 1 first.
    pub fn depth_at(&self, z: f32) -> f32 {
        let [scale, offset] = self.depth_mapping();
        super::unit(super::unit(z) * scale + offset)
    }
}

/// One step of `D3DRS_ZBIAS`.
pub(super) const DEPTH_BIAS_STEP: f64 = 1.0 / 65535.0;

/// `D3DVIEWPORT8` as a draw has it, for targets of any size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewportState {
    /// Left edge in pixels.
    pub x: u32,
    /// Upper edge in pixels.
    pub y: u32,
    /// Width in pixels; `None`: up to the right edge of the target.
    pub width: Option<u32>,
    /// Height in pixels; `None`: down to the lower edge of the target.
    pub height: Option<u32>,
    /// The depth of z = 0, taken into 0 to 1.
    pub min_z: f32,
    /// The depth of z = w, taken into 0 to 1. It may be smaller than the other.
    pub max_z: f32,
}

impl Default for ViewportState {
    fn default() -> Self {
        Self {
            x: 0,
            y: 0,
            width: None,
            height: None,
            min_z: 0.0,
            max_z: 1.0,
        }
    }
}

impl ViewportState {
    /// The viewport on a target of this size. What of it lies outside of the target is not drawn.
    pub fn on(&self, [width, height]: [u32; 2]) -> Viewport {
        Viewport {
            x: self.x,
            y: self.y,
            width: self.width.unwrap_or(width.saturating_sub(self.x)),
            height: self.height.unwrap_or(height.saturating_sub(self.y)),
            min_z: self.min_z,
            max_z: self.max_z,
        }
    }
}

/// The part of the target that clip space is mapped to, in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewport {
    /// Left edge.
    pub x: u32,
    /// Upper edge.
    pub y: u32,
    /// Width; 0 draws nothing.
    pub width: u32,
    /// Height; 0 draws nothing.
    pub height: u32,
    /// The depth of z = 0, taken into 0 to 1.
    pub min_z: f32,
    /// The depth of z = w, taken into 0 to 1.
    pub max_z: f32,
}

impl Viewport {
    /// The whole of a target of that size, with depths from 0 to 1.
    pub fn full(width: u32, height: u32) -> Self {
        Self {
            x: 0,
            y: 0,
            width,
            height,
            min_z: 0.0,
            max_z: 1.0,
        }
    }

    /// Left, top, width and height.
    pub fn rectangle(&self) -> [u32; 4] {
        [self.x, self.y, self.width, self.height]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_direct3d_and_read_back() {
        assert_eq!("srcalpha".parse(), Ok(BlendFactor::SrcAlpha));
        assert_eq!("bothinvsrcalpha".parse(), Ok(BlendFactor::BothInvSrcAlpha));
        assert_eq!("lessequal".parse(), Ok(Compare::LessEqual));
        assert_eq!("ccw".parse(), Ok(CullMode::Ccw));
        for factor in BlendFactor::ALL {
            assert_eq!(factor.name().parse(), Ok(*factor));
        }
        // The numbers of fixed-function.md, sections 12 and 13.
        assert_eq!(BlendFactor::SrcAlphaSat.number(), 11);
        assert_eq!(BlendOp::Max.number(), 5);
        assert_eq!(Compare::Always.number(), 8);
        assert_eq!(CullMode::Ccw.number(), 3);
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let error = "src_alpha".parse::<BlendOp>().unwrap_err();
        assert_eq!(
            error.to_string(),
            "`src_alpha` is no blend operation; it is one of add, subtract, revsubtract, min, max"
        );
    }

    #[test]
    fn defaults_are_those_of_the_runtime() {
        // fixed-function.md, sections 11 to 16.
        let state = RenderState::default();
        assert_eq!(state.cull, CullMode::Ccw);
        assert_eq!(state.shade, ShadeMode::Gouraud);
        assert_eq!(state.fill, FillMode::Solid);
        assert_eq!(state.depth.func, Compare::LessEqual);
        assert!(state.depth.enable && state.depth.write);
        assert!(!state.alpha_test.enable && !state.blend.enable && !state.fog.enable);
        assert_eq!(state.color_mask.bits(), 0xf);
        assert_eq!(
            (state.fog.start, state.fog.end, state.fog.density),
            (0.0, 1.0, 1.0)
        );
        assert_eq!(state.point.min, 0.0);
    }
}
