//! The render states that a single pixel shows, each value told apart from every other.

use super::Checklist;
use super::probe::{PROBES, Probe};
use std::fmt::Display;
use texcrd::case::Quantity;
use texcrd::raster::{
    BlendFactor, BlendOp, ColorFormat, ColorMask, Compare, FogDistance, FogMode, RenderState,
    Surface,
};

/// Cases that look at the pixel in the target.
fn frames() -> impl Iterator<Item = &'static Probe> {
    PROBES.iter().filter(|probe| {
        let invocations = &probe.case.invocations;
        let mut values = invocations.iter().flat_map(|i| &i.expect.values);
        values.any(|value| value.quantity == Quantity::Frame)
    })
}

/// One state whose values have names: in which cases it is switched on, what it is, how it is set.
struct State<T: 'static> {
    name: &'static str,
    values: Vec<T>,
    on: fn(&RenderState) -> bool,
    get: fn(&RenderState) -> T,
    set: fn(&mut RenderState, T),
    /// Whether a case can tell two values apart.
    differ: fn(T, T) -> bool,
}

impl<T: Copy + Display + PartialEq> State<T> {
    fn check(&self) {
        let item = |value: T, other: T| format!("{} {value} told from {other}", self.name);
        let pairs = self.values.iter().flat_map(|value| {
            let others = self.values.iter();
            others
                .filter(move |other| *other != value && (self.differ)(*value, **other))
                .map(move |other| item(*value, *other))
        });
        let mut list = Checklist::new(self.name, pairs);
        for probe in frames().filter(|probe| (self.on)(&probe.case.state)) {
            let value = (self.get)(&probe.case.state);
            for other in &self.values {
                list.tick(&item(value, *other), || {
                    probe.notices(|case| (self.set)(&mut case.state, *other))
                });
            }
        }
        list.finish();
    }
}

#[test]
fn every_comparison() {
    let values = || Compare::ALL.to_vec();
    State {
        name: "alpha_func",
        values: values(),
        on: |state| state.alpha_test.enable,
        get: |state| state.alpha_test.func,
        set: |state, value| state.alpha_test.func = value,
        differ: |_, _| true,
    }
    .check();
    State {
        name: "z_func",
        values: values(),
        on: |state| state.depth.enable,
        get: |state| state.depth.func,
        set: |state, value| state.depth.func = value,
        differ: |_, _| true,
    }
    .check();
    State {
        name: "stencil func",
        values: values(),
        on: |state| state.stencil.enable,
        get: |state| state.stencil.func,
        set: |state, value| state.stencil.func = value,
        differ: |_, _| true,
    }
    .check();
}

#[test]
fn every_blend_state() {
    State {
        name: "src_blend",
        values: BlendFactor::ALL.to_vec(),
        on: |state| state.blend.enable,
        get: |state| state.blend.source,
        set: |state, value| state.blend.source = value,
        differ: |_, _| true,
    }
    .check();
    let both = [BlendFactor::BothSrcAlpha, BlendFactor::BothInvSrcAlpha];
    State {
        name: "dest_blend",
        // Those two are source factors only.
        values: (BlendFactor::ALL.iter().copied())
            .filter(|factor| !both.contains(factor))
            .collect(),
        on: |state| state.blend.enable,
        get: |state| state.blend.destination,
        set: |state, value| state.blend.destination = value,
        differ: |_, _| true,
    }
    .check();
    State {
        name: "blend_op",
        values: BlendOp::ALL.to_vec(),
        on: |state| state.blend.enable,
        get: |state| state.blend.op,
        set: |state, value| state.blend.op = value,
        differ: |_, _| true,
    }
    .check();
}

#[test]
fn every_fog_mode() {
    State {
        name: "fog table",
        values: FogMode::ALL.to_vec(),
        on: |state| state.fog.enable,
        get: |state| state.fog.table,
        set: |state, value| state.fog.table = value,
        differ: |_, _| true,
    }
    .check();
    State {
        name: "fog distance",
        values: FogDistance::ALL.to_vec(),
        on: |state| state.fog.enable && state.fog.table != FogMode::None,
        get: |state| state.fog.distance,
        set: |state, value| state.fog.distance = value,
        differ: |_, _| true,
    }
    .check();
}

/// What the target is and holds before it is drawn into, each changed to something else.
#[test]
fn every_target() {
    type Spoil = fn(&mut Surface);
    let targets: [(&str, Spoil); 5] = [
        ("format a8r8g8b8", |s| match s.format {
            ColorFormat::A8R8G8B8 => s.format = ColorFormat::X8R8G8B8,
            ColorFormat::X8R8G8B8 => {}
        }),
        ("format x8r8g8b8", |s| match s.format {
            ColorFormat::X8R8G8B8 => s.format = ColorFormat::A8R8G8B8,
            ColorFormat::A8R8G8B8 => {}
        }),
        ("clear", |s| s.color = s.color.map(|c| 1.0 - c)),
        ("clear_depth", |s| s.depth = 1.0 - s.depth),
        ("clear_stencil", |s| s.stencil = !s.stencil),
    ];
    let mut list = Checklist::new(
        "targets",
        targets.iter().map(|(name, _)| (*name).to_owned()),
    );
    for probe in PROBES.iter() {
        for (name, spoil) in targets {
            list.tick(name, || probe.notices(|case| spoil(&mut case.target)));
        }
    }
    list.finish();
}

/// Numbers and switches, each changed to something else.
#[test]
fn every_number_and_switch() {
    type Spoil = fn(&mut RenderState);
    let states: [(&str, Spoil); 18] = [
        ("alpha_test", |s| s.alpha_test.enable = !s.alpha_test.enable),
        ("alpha_ref", |s| {
            s.alpha_test.reference = s.alpha_test.reference.wrapping_add(64)
        }),
        ("alpha_blend", |s| s.blend.enable = !s.blend.enable),
        ("z_enable on", |s| {
            if s.depth.enable {
                s.depth.enable = false;
            }
        }),
        ("z_enable off", |s| {
            if !s.depth.enable {
                s.depth.enable = true;
            }
        }),
        ("fog enable", |s| s.fog.enable = !s.fog.enable),
        ("fog color", |s| s.fog.color = s.fog.color.map(|c| 1.0 - c)),
        ("fog start", |s| s.fog.start -= 0.5),
        ("fog end", |s| s.fog.end += 0.5),
        ("fog density", |s| s.fog.density *= 0.5),
        ("stencil enable", |s| s.stencil.enable = !s.stencil.enable),
        ("stencil ref", |s| {
            s.stencil.reference = !s.stencil.reference
        }),
        ("stencil mask", |s| s.stencil.mask = !s.stencil.mask),
        ("color_write", |s| {
            s.color_mask = ColorMask::from_bits(!s.color_mask.bits())
        }),
        ("point_size", |s| s.point.size += 1.0),
        ("z_bias", |s| s.depth.bias ^= 8),
        ("viewport min_z", |s| {
            s.viewport.min_z = 1.0 - s.viewport.min_z
        }),
        ("viewport max_z", |s| s.viewport.max_z *= 0.5),
    ];
    let mut list = Checklist::new("states", states.iter().map(|(name, _)| (*name).to_owned()));
    for probe in PROBES.iter() {
        for (name, spoil) in states {
            list.tick(name, || probe.notices(|case| spoil(&mut case.state)));
        }
    }
    list.finish();
}

#[test]
fn every_color_mask() {
    let item = |bits: u8| format!("color_write {bits:#06b}");
    let mut list = Checklist::new("write masks of the target", (0..16).map(item));
    for probe in frames() {
        let mask = probe.case.state.color_mask;
        list.tick(&item(mask.bits()), || {
            (0..4).all(|bit| {
                let other = ColorMask::from_bits(mask.bits() ^ 1 << bit);
                probe.notices(|case| case.state.color_mask = other)
            })
        });
    }
    list.finish();
}
