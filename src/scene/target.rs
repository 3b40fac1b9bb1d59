//! `[targets.NAME]`, and in which order targets are rendered.

use std::str::FromStr;

use glam::{Mat4, Vec3};

use super::draw::{Names, find};
use super::error::{Problems, rules};
use super::files::Files;
use super::section::{At, Exactly, Section};
use super::state::surface;
use super::transform::{Camera, cube_face, depth_range};
use crate::diagnostic::Span;
use crate::raster::Surface;

/// The longest side of a render target that a texture shows, in pixels.
pub const MAX_TARGET_SIDE: u32 = 4096;

/// The two kinds of render target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Flat,
    Cube,
}

impl FromStr for Kind {
    type Err = &'static str;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name {
            "2d" => Ok(Self::Flat),
            "cube" => Ok(Self::Cube),
            _ => Err("a render target is `2d` or `cube`"),
        }
    }
}

/// From where a target is seen.
#[derive(Clone, Copy, Debug)]
pub(super) enum View {
    /// One picture.
    Camera(Camera),
    /// Six, in the order of the faces.
    Cube { from: Vec3, near: f32, far: f32 },
}

/// A render target.
#[derive(Clone, Debug)]
pub(super) struct Target {
    pub(super) name: String,
    pub(super) span: Span,
    pub(super) size: [u32; 2],
    pub(super) surface: Surface,
    pub(super) view: View,
    /// The draws by number, in order.
    pub(super) draws: Vec<usize>,
    pub(super) mipmaps: bool,
}

impl Target {
    /// How many pictures it takes.
    pub(super) fn faces(&self) -> usize {
        match self.view {
            View::Camera(_) => 1,
            View::Cube { .. } => 6,
        }
    }

    /// View and projection of a face.
    pub(super) fn matrices(&self, face: usize) -> (Mat4, Mat4) {
        match &self.view {
            View::Camera(camera) => {
                let [width, height] = self.size.map(|side| side as f32);
                camera.matrices(width / height)
            }
            View::Cube { from, near, far } => cube_face(face, *from, *near, *far, self.size[0]),
        }
    }
}

/// Reads a target.
pub(super) fn read(
    name: String,
    mut section: Section<'_>,
    draws: &Names,
    files: &mut Files<'_>,
    problems: &mut Problems,
) -> Option<Target> {
    let s = &mut section;
    let span = s.span;
    let kind = s.named("kind", Kind::Flat, problems);
    let surface = surface(s, [0.0; 4], problems);
    let mipmaps = s.or("mipmaps", false, problems);
    if !s.has("draws") {
        s.missing("`draws`", problems);
    }
    let draws = s.node("draws").map(|node| draw_list(node, draws, problems));
    let size = size(s, kind, problems);
    let view = match kind {
        Kind::Flat => View::Camera(match s.table("camera", problems) {
            Some(table) => Camera::read(table, problems),
            None => Camera::default(),
        }),
        Kind::Cube => {
            let from: [f32; 3] = s.array_or("from", [0.0; 3], problems);
            let (near, far) = depth_range(s, problems);
            View::Cube {
                from: from.into(),
                near,
                far,
            }
        }
    };
    section.finish(problems);
    let size = size?;
    let target = Target {
        name,
        span,
        size,
        surface,
        view,
        draws: draws?,
        mipmaps,
    };
    let texels = u64::from(size[0]) * u64::from(size[1]) * target.faces() as u64;
    files.take_texels(texels, span, problems).then_some(target)
}

/// A list of draws by name.
pub(super) fn draw_list(
    node: super::section::Node<'_>,
    draws: &Names,
    problems: &mut Problems,
) -> Vec<usize> {
    let names = node.read::<Vec<toml::Spanned<String>>>(problems);
    let mut numbers = Vec::new();
    for name in names.map(|at| at.value).unwrap_or_default() {
        let span = problems.span(name.span());
        let value = name.into_inner();
        numbers.extend(find(draws, "draw", &At { value, span }, problems));
    }
    numbers
}

/// `size`: two numbers, or one for a square.
fn size(s: &mut Section<'_>, kind: Kind, problems: &mut Problems) -> Option<[u32; 2]> {
    let Some(node) = s.node("size") else {
        s.missing("a `size`", problems);
        return None;
    };
    let At { value, span } = match node.value.get_ref() {
        toml::de::DeValue::Array(_) => {
            let At { value, span } = node.read::<Exactly<u32, 2>>(problems)?;
            let value = value.0;
            At { value, span }
        }
        _ => {
            let At { value, span } = node.read::<u32>(problems)?;
            let value = [value; 2];
            At { value, span }
        }
    };
    let wrong = if kind == Kind::Cube && value[0] != value[1] {
        "the faces of a cube are square".to_owned()
    } else if value
        .iter()
        .any(|side| !(1..=MAX_TARGET_SIDE).contains(side))
    {
        format!("each side is 1 to {MAX_TARGET_SIDE} pixels")
    } else {
        return Some(value);
    };
    let message = format!("a target of {} by {}: {wrong}", value[0], value[1]);
    problems.error(&rules::VALUE, span, message);
    None
}

/// The targets in an order in which each comes after those that it reads. `reads(i)` are the targets that target `i` reads.
///
/// A cycle is a problem, with all that take part in it.
pub(super) fn order(
    targets: &[Target],
    reads: impl Fn(usize) -> Vec<usize>,
    problems: &mut Problems,
) -> Vec<usize> {
    let mut waits: Vec<Vec<usize>> = (0..targets.len()).map(reads).collect();
    let mut done = Vec::with_capacity(targets.len());
    let mut left: Vec<usize> = (0..targets.len()).collect();
    while !left.is_empty() {
        let ready = left.iter().position(|&i| waits[i].is_empty());
        let Some(ready) = ready else {
            report_cycle(targets, &waits, &left, problems);
            break;
        };
        let target = left.remove(ready);
        done.push(target);
        for wait in &mut waits {
            wait.retain(|&other| other != target);
        }
    }
    done
}

fn report_cycle(targets: &[Target], waits: &[Vec<usize>], left: &[usize], problems: &mut Problems) {
    // Everyone left waits for someone left, so that following the first wait must come back somewhere.
    let mut path: Vec<usize> = Vec::new();
    let Some(&first) = left.first() else { return };
    let mut at = first;
    while !path.contains(&at) {
        path.push(at);
        let Some(&next) = waits[at].first() else {
            return;
        };
        at = next;
    }
    let start = path.iter().position(|&i| i == at).unwrap_or(0);
    let names: Vec<String> = path[start..]
        .iter()
        .chain([&at])
        .map(|&i| format!("`{}`", targets[i].name))
        .collect();
    let message = if names.len() == 2 {
        format!("the target {} is read by one of its own draws", names[0])
    } else {
        format!("these targets read each other: {}", names.join(" reads "))
    };
    problems.error(&rules::CYCLE, targets[at].span, message);
}
