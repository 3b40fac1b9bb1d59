//! Matrices of a scene file: world transforms and cameras.
//!
//! A scene file writes matrices as Direct3D does, for row vectors: `v · World · View · Projection`, the translation in the
//! last row. In memory they are `glam`'s, for column vectors, so that the rows of the file become columns.

use glam::camera::lh::proj::directx::perspective;
use glam::{EulerRot, Mat4, Quat, Vec3, Vec4};
use toml::de::DeValue;

use super::error::{Problems, rules};
use super::section::{At, Exactly, Node, Section};
use crate::texture::CUBE_FACES;

/// Reads four rows of four numbers.
pub(super) fn matrix(node: Node<'_>, problems: &mut Problems) -> Option<Mat4> {
    let shape = "a matrix is four rows of four numbers";
    let DeValue::Array(rows) = node.value.get_ref() else {
        node.refuse("a matrix, four rows of four numbers", problems);
        return None;
    };
    let key = &node.key;
    for (row, number) in rows.iter().zip(1..) {
        let wrong = match row.get_ref() {
            DeValue::Array(row) if row.len() == 4 => continue,
            DeValue::Array(row) => format!("row {number} of `{key}` has {} numbers", row.len()),
            _ => format!("row {number} of `{key}` is not a list"),
        };
        let span = problems.span(row.span());
        problems.error(&rules::VALUE, span, format!("{wrong}; {shape}"));
        return None;
    }
    if rows.len() != 4 {
        let message = format!("`{key}` has {} rows; {shape}", rows.len());
        problems.error(&rules::VALUE, node.span(problems), message);
        return None;
    }
    let key = node.key.clone();
    let At { value, span } = node.read::<[[f32; 4]; 4]>(problems)?;
    finite(&key, Mat4::from_cols_array_2d(&value), span, problems)
}

fn finite(
    key: &str,
    matrix: Mat4,
    span: crate::diagnostic::Span,
    problems: &mut Problems,
) -> Option<Mat4> {
    if matrix.is_finite() {
        return Some(matrix);
    }
    let message = format!("`{key}` holds an infinite number or one that is none");
    problems.error(&rules::VALUE, span, message);
    None
}

/// Reads a transform: a matrix, or a table of `scale` (a number or three), `rotate` (degrees about x, then y, then z)
/// and `translate`, which take place in this order.
pub(super) fn transform(node: Node<'_>, problems: &mut Problems) -> Option<Mat4> {
    match node.value.get_ref() {
        DeValue::Array(_) => return matrix(node, problems),
        DeValue::Table(_) => {}
        _ => {
            let expected = "four rows of four numbers, or { scale, rotate, translate }";
            node.refuse(expected, problems);
            return None;
        }
    }
    let (key, span) = (node.key.clone(), node.span(problems));
    let mut table = node.into_section(format!("`{key}`"), problems)?;
    let scale = match table.node("scale") {
        Some(node) if matches!(node.value.get_ref(), DeValue::Array(_)) => node
            .read::<Exactly<f32, 3>>(problems)
            .map_or(Vec3::ONE, |at| Vec3::from_array(at.value.0)),
        Some(node) => node
            .read::<f32>(problems)
            .map_or(Vec3::ONE, |at| Vec3::splat(at.value)),
        None => Vec3::ONE,
    };
    let rotate: [f32; 3] = table.array_or("rotate", [0.0; 3], problems);
    let translate: [f32; 3] = table.array_or("translate", [0.0; 3], problems);
    table.finish(problems);
    let [x, y, z] = rotate.map(f32::to_radians);
    // The quaternion turns about x first: from right to left, as column vectors have it.
    let rotation = Quat::from_euler(EulerRot::ZYX, z, y, x);
    let matrix = Mat4::from_scale_rotation_translation(scale, rotation, translate.into());
    finite(&key, matrix, span, problems)
}

/// What sees a picture: the view matrix, and a projection that may depend on the shape of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Camera {
    view: Mat4,
    /// What the camera looks at and turns about; where the file gives a view matrix, the origin.
    turns_about: Vec3,
    /// How far it is turned, in degrees.
    turned: f32,
    projection: Projection,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Projection {
    /// Vertical angle in radians, distances of the near and the far plane.
    Perspective { fov: f32, near: f32, far: f32 },
    /// As it is.
    Matrix(Mat4),
}

impl Default for Camera {
    /// None: what the world matrix gives is already in clip space.
    fn default() -> Self {
        Self {
            view: Mat4::IDENTITY,
            turns_about: Vec3::ZERO,
            turned: 0.0,
            projection: Projection::Matrix(Mat4::IDENTITY),
        }
    }
}

impl Camera {
    /// Reads `[camera]`.
    pub(super) fn read(mut section: Section<'_>, problems: &mut Problems) -> Self {
        let (view, turns_about) = match section.node("view") {
            Some(node) => {
                let from = ["position", "look_at", "up"];
                if let Some(key) = from.into_iter().find(|key| section.has(key)) {
                    let message = format!("`view` already says what `{key}` would");
                    problems.error(&rules::TWICE, node.key_span, message);
                }
                for key in from {
                    section.node(key);
                }
                let view = matrix(node, problems).unwrap_or(Mat4::IDENTITY);
                (view, Vec3::ZERO)
            }
            None => Self::look(&mut section, problems),
        };
        let projection = match section.node("projection") {
            Some(node) => {
                let from = ["fov", "near", "far"];
                if let Some(key) = from.into_iter().find(|key| section.has(key)) {
                    let message = format!("`projection` already says what `{key}` would");
                    problems.error(&rules::TWICE, node.key_span, message);
                }
                for key in from {
                    section.node(key);
                }
                Projection::Matrix(matrix(node, problems).unwrap_or(Mat4::IDENTITY))
            }
            None => {
                let fov = section.ranged("fov", 1.0..=179.0, 45.0_f32, problems);
                let (near, far) = depth_range(&mut section, problems);
                let fov = fov.to_radians();
                Projection::Perspective { fov, near, far }
            }
        };
        section.finish(problems);
        Self {
            view,
            turns_about,
            turned: 0.0,
            projection,
        }
    }

    /// The view, and the point that is looked at.
    fn look(section: &mut Section<'_>, problems: &mut Problems) -> (Mat4, Vec3) {
        let position: [f32; 3] = section.array_or("position", [0.0; 3], problems);
        let position = Vec3::from_array(position);
        let look_at = section.array::<f32, 3>("look_at", problems);
        let up = section.array::<f32, 3>("up", problems);
        let place = look_at
            .as_ref()
            .or(up.as_ref())
            .map_or(section.span, |at| at.span);
        let target = look_at.map_or(position + Vec3::Z, |at| Vec3::from_array(at.value));
        let up = up.map_or(Vec3::Y, |at| Vec3::from_array(at.value));
        let forward = (target - position).normalize_or_zero();
        let right = up.cross(forward).normalize_or_zero();
        if forward == Vec3::ZERO || right == Vec3::ZERO {
            let message = "the camera must look at another point than its position, and `up` must not lie on its line of sight";
            problems.error(&rules::VALUE, place, message);
            return (Mat4::IDENTITY, target);
        }
        let view = view(position, right, forward.cross(right), forward);
        (view, target)
    }

    /// Turns the camera from where the scene file has it: see [`Scene::turn_camera`](super::Scene::turn_camera).
    pub(super) fn turn(&mut self, degrees: f32) {
        self.turned = degrees;
    }

    /// View and projection for a picture of this width over height.
    pub(super) fn matrices(&self, aspect: f32) -> (Mat4, Mat4) {
        let projection = match self.projection {
            Projection::Perspective { fov, near, far } => perspective(fov, aspect, near, far),
            Projection::Matrix(matrix) => matrix,
        };
        if self.turned == 0.0 {
            return (self.view, projection);
        }
        // The camera goes one way around the world if the world goes the other way before it.
        let around = Mat4::from_rotation_y(-self.turned.to_radians());
        let to = Mat4::from_translation(self.turns_about);
        let turned = to * around * Mat4::from_translation(-self.turns_about);
        (self.view * turned, projection)
    }
}

/// Reads `near` and `far`.
pub(super) fn depth_range(section: &mut Section<'_>, problems: &mut Problems) -> (f32, f32) {
    let near = section.at::<f32>("near", problems);
    let far = section.at::<f32>("far", problems);
    let place = far.as_ref().or(near.as_ref()).map(|at| at.span);
    let (near, far) = (
        near.map_or(0.1, |at| at.value),
        far.map_or(100.0, |at| at.value),
    );
    if near > 0.0 && near < far && far.is_finite() {
        return (near, far);
    }
    let message = format!("`near` is {near} and `far` is {far}; it must be 0 < near < far");
    problems.error(&rules::VALUE, place.unwrap_or(section.span), message);
    (0.1, 100.0)
}

/// The view matrix of an observer with these axes.
fn view(position: Vec3, right: Vec3, up: Vec3, forward: Vec3) -> Mat4 {
    Mat4::from_cols(
        right.extend(0.0),
        up.extend(0.0),
        forward.extend(0.0),
        Vec4::W,
    )
    .transpose()
        * Mat4::from_translation(-position)
}

/// View and projection for a face (0 to 5) of a cube texture that is rendered from a point.
///
/// The face table says which direction a texel shows: `sc` grows to the right, `tc` downwards, `ma` goes through the
/// middle. Direct3D 8 has pixel centres at whole numbers and texel centres half-way between, so that a picture stands
/// half a texel off when it is read as a texture. The projection takes this back: each texel holds what lies in the
/// direction in which it is found, and the faces meet at their edges.
pub(super) fn cube_face(face: usize, from: Vec3, near: f32, far: f32, size: u32) -> (Mat4, Mat4) {
    let Some(axes) = CUBE_FACES.get(face) else {
        return (Mat4::IDENTITY, Mat4::IDENTITY);
    };
    let [right, down, forward] = [axes.sc, axes.tc, axes.ma].map(|axis| {
        let sign = if axis.negative { -1.0 } else { 1.0 };
        Vec3::from_array(std::array::from_fn(
            |i| if i == axis.axis { sign } else { 0.0 },
        ))
    });
    let half_texel = 1.0 / size.max(1) as f32;
    let shift = Mat4::from_translation(Vec3::new(-half_texel, half_texel, 0.0));
    let projection = perspective(std::f32::consts::FRAC_PI_2, 1.0, near, far);
    (view(from, right, -down, forward), shift * projection)
}
