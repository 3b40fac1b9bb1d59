//! Shader constants by value and by meaning.

use glam::{Mat4, Vec3, Vec4};
use toml::de::DeValue;

use super::error::{Problems, advice, rules};
use super::section::{Node, Section};
use super::transform::matrix;
use crate::diagnostic::Span;

/// The matrices that a constant can mean, by the name that a scene file uses.
const MATRICES: [(&str, Matrix); 6] = [
    ("world", Matrix::World),
    ("view", Matrix::View),
    ("projection", Matrix::Projection),
    ("world_view", Matrix::WorldView),
    ("view_projection", Matrix::ViewProjection),
    ("world_view_projection", Matrix::WorldViewProjection),
];

/// The vectors that a constant can mean.
const VECTORS: [(&str, Meaning); 6] = [
    ("camera_position", Meaning::CameraPosition),
    ("object_camera_position", Meaning::ObjectCameraPosition),
    ("light_direction", Meaning::LightDirection),
    ("object_light_direction", Meaning::ObjectLightDirection),
    ("time", Meaning::Time),
    ("target_size", Meaning::TargetSize),
];

/// In front of the name of a matrix: (text, inverse, transpose).
const PREFIXES: [(&str, bool, bool); 4] = [
    ("inverse_transpose_", true, true),
    ("inverse_", true, false),
    ("transpose_", false, true),
    ("", false, false),
];

/// A matrix of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Matrix {
    World,
    View,
    Projection,
    WorldView,
    ViewProjection,
    WorldViewProjection,
}

/// What a constant stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// A matrix, perhaps inverted, perhaps transposed.
    Matrix {
        matrix: Matrix,
        inverse: bool,
        transpose: bool,
    },
    /// The position of the camera in the world; w is 1.
    CameraPosition,
    /// The position of the camera in object space; w is 1.
    ObjectCameraPosition,
    /// `light_direction` of the scene with length 1; w is 0.
    LightDirection,
    /// The same in object space, with length 1; w is 0.
    ObjectLightDirection,
    /// `time` of the scene in all components.
    Time,
    /// Width, height, 1 / width, 1 / height of what is drawn into.
    TargetSize,
}

impl Meaning {
    fn from_name(name: &str) -> Option<Self> {
        if let Some((_, meaning)) = VECTORS.iter().find(|(known, _)| *known == name) {
            return Some(*meaning);
        }
        let (rest, inverse, transpose) =
            PREFIXES.iter().find_map(|&(prefix, inverse, transpose)| {
                Some((name.strip_prefix(prefix)?, inverse, transpose))
            })?;
        let (_, matrix) = MATRICES.iter().find(|(known, _)| *known == rest)?;
        Some(Self::Matrix {
            matrix: *matrix,
            inverse,
            transpose,
        })
    }

    /// Every name that has a meaning.
    pub(super) fn names() -> Vec<String> {
        let matrices = PREFIXES.iter().rev().flat_map(|(prefix, ..)| {
            MATRICES
                .iter()
                .map(move |(name, _)| format!("{prefix}{name}"))
        });
        let vectors = VECTORS.iter().map(|(name, _)| (*name).to_owned());
        vectors.chain(matrices).collect()
    }

    /// How many registers it fills.
    fn registers(self) -> u32 {
        match self {
            Self::Matrix { .. } => 4,
            _ => 1,
        }
    }
}

/// What meanings are taken from: one draw in one view. Matrices are for column vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surroundings {
    pub(super) world: Mat4,
    pub(super) view: Mat4,
    pub(super) projection: Mat4,
    pub(super) light_direction: Vec3,
    pub(super) time: f32,
    pub(super) size: [u32; 2],
}

impl Surroundings {
    /// The registers of a meaning. `None` if a matrix has no inverse.
    ///
    /// A matrix is uploaded as Direct3D programs did, transposed: each register is a column of the row-vector matrix, so
    /// that `m4x4 oPos, v0, c#` multiplies the vector by it.
    pub(super) fn registers(&self, meaning: Meaning) -> Option<Vec<[f32; 4]>> {
        let vector = match meaning {
            Meaning::Matrix {
                matrix,
                inverse: inverted,
                transpose,
            } => {
                let mut matrix = self.matrix(matrix);
                if inverted {
                    matrix = inverse(matrix)?;
                }
                if transpose {
                    matrix = matrix.transpose();
                }
                return Some(rows(matrix));
            }
            Meaning::CameraPosition => self.camera_position()?.extend(1.0),
            Meaning::ObjectCameraPosition => inverse(self.world)?
                .transform_point3(self.camera_position()?)
                .extend(1.0),
            Meaning::LightDirection => self.light_direction.normalize_or_zero().extend(0.0),
            Meaning::ObjectLightDirection => inverse(self.world)?
                .transform_vector3(self.light_direction)
                .normalize_or_zero()
                .extend(0.0),
            Meaning::Time => Vec4::splat(self.time),
            Meaning::TargetSize => {
                let [width, height] = self.size.map(|side| side as f32);
                Vec4::new(width, height, width.recip(), height.recip())
            }
        };
        Some(vec![vector.to_array()])
    }

    fn matrix(&self, matrix: Matrix) -> Mat4 {
        match matrix {
            Matrix::World => self.world,
            Matrix::View => self.view,
            Matrix::Projection => self.projection,
            Matrix::WorldView => self.view * self.world,
            Matrix::ViewProjection => self.projection * self.view,
            Matrix::WorldViewProjection => self.projection * self.view * self.world,
        }
    }

    fn camera_position(&self) -> Option<Vec3> {
        Some(inverse(self.view)?.w_axis.truncate())
    }
}

/// The inverse, if there is one whose numbers are finite.
fn inverse(matrix: Mat4) -> Option<Mat4> {
    // In double precision, since the determinant of a small object's matrix leaves the range of single precision.
    let matrix = matrix.as_dmat4();
    if matrix.determinant() == 0.0 {
        return None;
    }
    Some(matrix.inverse().as_mat4()).filter(|inverse| inverse.is_finite())
}

fn rows(matrix: Mat4) -> Vec<[f32; 4]> {
    matrix.transpose().to_cols_array_2d().to_vec()
}

/// A constant of a draw.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Constant {
    /// The first register.
    pub(super) register: u32,
    /// How many registers it fills.
    pub(super) count: u32,
    pub(super) value: Value,
    /// Where its value stands in the scene file.
    pub(super) span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    /// The registers themselves.
    Registers(Vec<[f32; 4]>),
    /// What they mean.
    Meaning(Meaning),
}

impl Constant {
    /// The registers with their numbers. `None` if a matrix has no inverse.
    pub(super) fn bind(&self, surroundings: &Surroundings) -> Option<Vec<(u32, [f32; 4])>> {
        let registers = match &self.value {
            Value::Registers(registers) => registers.clone(),
            Value::Meaning(meaning) => surroundings.registers(*meaning)?,
        };
        let numbers = self.register..self.register.saturating_add(self.count);
        Some(numbers.zip(registers).collect())
    }
}

/// Reads `[draw.vs_constants]` or `[draw.ps_constants]`; `limit` is how many registers there are.
pub(super) fn constants(
    mut section: Section<'_>,
    limit: u32,
    problems: &mut Problems,
) -> Vec<Constant> {
    let mut all: Vec<(Constant, String)> = Vec::new();
    for node in section.rest() {
        let (key, key_span) = (node.key.clone(), node.key_span);
        let register = key
            .strip_prefix('c')
            .filter(|digits| !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit()))
            .and_then(|digits| digits.parse::<u32>().ok())
            .filter(|register| *register < limit);
        let Some(register) = register else {
            let message = format!("{} has no register `{key}`", section.title);
            let help = Some(format!("there are `c0` to `c{}`", limit - 1));
            problems.error_with(&rules::KEY, key_span, message, help);
            continue;
        };
        let span = node.span(problems);
        let Some((value, count)) = value(node, problems) else {
            continue;
        };
        if register + count > limit {
            let message = format!(
                "`{key}` fills c{register} to c{}, but the last register is c{}",
                register + count - 1,
                limit - 1
            );
            problems.error(&rules::VALUE, span, message);
            continue;
        }
        let overlap = all.iter().find(|(other, _)| {
            register < other.register + other.count && other.register < register + count
        });
        if let Some((other, name)) = overlap {
            let message = format!(
                "`{key}` and `{name}` both set c{}",
                register.max(other.register)
            );
            let help =
                "a matrix fills four registers; { meaning = \"…\", registers = 3 } fills three";
            problems.error_with(&rules::TWICE, key_span, message, Some(help.to_owned()));
            continue;
        }
        let constant = Constant {
            register,
            count,
            value,
            span,
        };
        all.push((constant, key));
    }
    all.into_iter().map(|(constant, _)| constant).collect()
}

/// A value and how many registers it fills.
fn value(node: Node<'_>, problems: &mut Problems) -> Option<(Value, u32)> {
    match node.value.get_ref() {
        DeValue::String(_) => {
            let meaning = meaning(node, problems)?;
            Some((Value::Meaning(meaning), meaning.registers()))
        }
        DeValue::Integer(_) | DeValue::Float(_) => {
            let number = node.read::<f32>(problems)?.value;
            Some((Value::Registers(vec![[number; 4]]), 1))
        }
        DeValue::Array(list)
            if list
                .first()
                .is_some_and(|first| matches!(first.get_ref(), DeValue::Array(_))) =>
        {
            Some((Value::Registers(rows(matrix(node, problems)?)), 4))
        }
        DeValue::Array(list) if (1..=4).contains(&list.len()) => {
            let numbers = node.read::<Vec<f32>>(problems)?.value;
            let mut register = [0.0; 4];
            for (component, number) in register.iter_mut().zip(numbers) {
                *component = number;
            }
            Some((Value::Registers(vec![register]), 1))
        }
        DeValue::Array(list) => {
            let message = format!(
                "`{}` has {} numbers; a register has four",
                node.key,
                list.len()
            );
            problems.error(&rules::VALUE, node.span(problems), message);
            None
        }
        DeValue::Table(_) => {
            let title = format!("`{}`", node.key);
            let mut table = node.into_section(title, problems)?;
            let meaning = match table.node("meaning") {
                Some(node) => meaning(node, problems),
                None => {
                    table.missing("a `meaning`", problems);
                    None
                }
            };
            let most = meaning.map_or(4, Meaning::registers);
            let count = table.ranged("registers", 1..=most, most, problems);
            table.finish(problems);
            Some((Value::Meaning(meaning?), count))
        }
        _ => {
            let expected = "a number, up to four numbers, four rows of four numbers or a meaning";
            node.refuse(expected, problems);
            None
        }
    }
}

fn meaning(node: Node<'_>, problems: &mut Problems) -> Option<Meaning> {
    let name = node.read::<String>(problems)?;
    let meaning = Meaning::from_name(&name.value);
    if meaning.is_none() {
        let names = Meaning::names();
        let help = advice(&name.value, names.iter().map(String::as_str));
        let message = format!("nothing is called `{}`", name.value);
        problems.error_with(&rules::NAME, name.span, message, help);
    }
    meaning
}
