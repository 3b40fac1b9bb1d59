//! `[meshes.NAME]`.

use std::collections::BTreeMap;

use glam::{Mat4, Vec2, Vec3, Vec4};
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use super::error::{Problems, advice_from, rules};
use super::files::Files;
use super::section::{Node, Section};
use super::transform::transform;
use crate::mesh::{Attribute, Mesh, MeshData, MeshError, ObjOptions, Shape};

/// The keys of which a mesh has one: what it is made from.
const SOURCES: [&str; 3] = ["shape", "obj", "positions"];

/// Reads a mesh.
pub(super) fn read(
    mut section: Section<'_>,
    files: &mut Files<'_>,
    problems: &mut Problems,
) -> Option<Mesh> {
    let span = section.span;
    let finish = Finish::read(&mut section, problems);
    let given: Vec<&str> = SOURCES.into_iter().filter(|key| section.has(key)).collect();
    let built = match given.as_slice() {
        ["shape"] => shape(section, problems)?,
        ["obj"] => {
            let path = section.at::<String>("obj", problems);
            let default = ObjOptions::default();
            let options = ObjOptions {
                right_handed: section.or("right_handed", default.right_handed, problems),
                v_up: section.or("v_up", default.v_up, problems),
            };
            section.finish(problems);
            let path = path?;
            let bytes = files.read(&path, problems)?;
            let name = files.resolver.display_name(&path.value);
            Mesh::from_obj(&bytes, options).map_err(|error| format!("`{name}`: {error}"))
        }
        [_] => {
            let data = inline(&mut section, problems);
            section.finish(problems);
            Mesh::new(data?).map_err(|error| error.to_string())
        }
        [] => {
            section.missing("one of `shape`, `obj`, `positions`", problems);
            return None;
        }
        [first, second, ..] => {
            let message =
                format!("a mesh is made from `{first}` or from `{second}`, not from both");
            problems.error(&rules::TWICE, span, message);
            return None;
        }
    };
    let finished = built.and_then(|mesh| finish.apply(mesh).map_err(|error| error.to_string()));
    match finished {
        Ok(mesh) => files.take_mesh(&mesh, span, problems).then_some(mesh),
        Err(message) => {
            problems.error(&rules::CONTENT, span, message);
            None
        }
    }
}

/// What is done to a mesh after it is made.
struct Finish {
    transform: Mat4,
    texcoord_scale: Vec2,
    texcoord_offset: Vec2,
    color: Option<Vec4>,
}

impl Finish {
    fn read(section: &mut Section<'_>, problems: &mut Problems) -> Self {
        let matrix = section.node("transform");
        Self {
            transform: matrix
                .and_then(|node| transform(node, problems))
                .unwrap_or(Mat4::IDENTITY),
            texcoord_scale: Vec2::from_array(section.array_or(
                "texcoord_scale",
                [1.0; 2],
                problems,
            )),
            texcoord_offset: Vec2::from_array(section.array_or(
                "texcoord_offset",
                [0.0; 2],
                problems,
            )),
            color: section
                .array("color", problems)
                .map(|at| Vec4::from_array(at.value)),
        }
    }

    fn apply(&self, mut mesh: Mesh) -> Result<Mesh, MeshError> {
        if self.transform != Mat4::IDENTITY {
            mesh = mesh.transformed(self.transform)?;
        }
        if (self.texcoord_scale, self.texcoord_offset) != (Vec2::ONE, Vec2::ZERO) {
            mesh = mesh.with_texcoords(self.texcoord_scale, self.texcoord_offset)?;
        }
        match self.color {
            Some(color) => mesh.with_color(color),
            None => Ok(mesh),
        }
    }
}

/// A built-in shape. Its keys are those of [`Shape`], which is asked about each alone when it refuses them together, so
/// that each problem gets its place.
fn shape(mut section: Section<'_>, problems: &mut Problems) -> Option<Result<Mesh, String>> {
    let name = section.node("shape")?;
    let parameters = section.rest();
    let ask = |nodes: &[&Node<'_>]| {
        let table: DeTable<'_> = nodes
            .iter()
            .map(|node| {
                let key = Spanned::new(0..0, node.key.clone().into());
                (key, node.value.clone())
            })
            .collect();
        Shape::deserialize(ValueDeserializer::from(Spanned::new(
            0..0,
            DeValue::Table(table),
        )))
    };
    let refuse = |error: toml::de::Error, span, problems: &mut Problems| {
        let (rule, text) = (&rules::VALUE, error.message());
        problems.error_with(rule, span, text, advice_from(text));
    };
    if let Err(error) = ask(&[&name]) {
        refuse(error, name.span(problems), problems);
        return None;
    }
    let all: Vec<&Node<'_>> = std::iter::once(&name).chain(&parameters).collect();
    let whole = match ask(&all) {
        Ok(shape) => return Some(shape.build().map_err(|error| error.to_string())),
        Err(error) => error,
    };
    let mut found = false;
    for node in &parameters {
        if let Err(error) = ask(&[&name, node]) {
            found = true;
            if error.message().starts_with("unknown field") {
                refuse(error, node.key_span, problems);
            } else {
                let message = format!("`{}`: {}", node.key, error.message());
                problems.error(&rules::VALUE, node.span(problems), message);
            }
        }
    }
    if !found {
        refuse(whole, name.span(problems), problems);
    }
    None
}

/// Lists written in the scene file.
fn inline(section: &mut Section<'_>, problems: &mut Problems) -> Option<MeshData> {
    let positions = vectors(section, "positions", problems, Vec3::from_array);
    let normals = vectors(section, "normals", problems, Vec3::from_array);
    let tangents = vectors(section, "tangents", problems, Vec3::from_array);
    let bitangents = vectors(section, "bitangents", problems, Vec3::from_array);
    let (texcoords, mut more) = texcoords(section, problems);
    let sets = Attribute::TEXCOORDS.into_iter().skip(1);
    for (attribute, key) in sets.zip(FURTHER_SETS) {
        let values = further(section, key, problems);
        more.extend(values.map(|values| (attribute, values)));
    }
    let speculars = vectors(section, "speculars", problems, Vec4::from_array);
    more.insert(Attribute::Specular, speculars);
    let colors = vectors(section, "colors", problems, Vec4::from_array);
    let indices: Option<Vec<u32>> = section.get("indices", problems);
    let whole = positions.len() - positions.len() % 3;
    Some(MeshData {
        positions,
        normals,
        tangents,
        bitangents,
        texcoords,
        colors,
        more,
        // Positions are bounded by the length of a scene file.
        indices: indices.unwrap_or_else(|| (0..whole as u32).collect()),
    })
}

/// The keys of coordinate sets 1 to 7.
const FURTHER_SETS: [&str; 7] = [
    "texcoords1",
    "texcoords2",
    "texcoords3",
    "texcoords4",
    "texcoords5",
    "texcoords6",
    "texcoords7",
];

/// Coordinate set 0: u and v, and all four where a vertex has more than two.
fn texcoords(
    section: &mut Section<'_>,
    problems: &mut Problems,
) -> (Vec<Vec2>, BTreeMap<Attribute, Vec<Vec4>>) {
    let all = further(section, "texcoords", problems).unwrap_or_default();
    let plain = all.iter().map(|set| Vec2::new(set.x, set.y)).collect();
    let beyond = all.iter().any(|set| (set.z, set.w) != (0.0, 1.0));
    let more = beyond.then_some((Attribute::Texcoord, all));
    (plain, more.into_iter().collect())
}

/// A list of one to four numbers a vertex, filled up from (0, 0, 0, 1).
fn further(
    section: &mut Section<'_>,
    key: &'static str,
    problems: &mut Problems,
) -> Option<Vec<Vec4>> {
    let lists = section.at::<Vec<Spanned<Vec<f32>>>>(key, problems)?.value;
    let mut values = Vec::with_capacity(lists.len());
    for list in lists {
        let (place, numbers) = (problems.span(list.span()), list.into_inner());
        if !(1..=4).contains(&numbers.len()) {
            let count = numbers.len();
            let message = format!("`{key}`: there are {count} entries where one to four must be");
            problems.error(&rules::VALUE, place, message);
            // One is enough: the others are probably wrong in the same way.
            return None;
        }
        let mut value = Vec4::W.to_array();
        for (component, number) in value.iter_mut().zip(numbers) {
            *component = number;
        }
        values.push(Vec4::from_array(value));
    }
    Some(values)
}

/// A list of vectors; empty if there is none.
fn vectors<T, const N: usize>(
    section: &mut Section<'_>,
    key: &'static str,
    problems: &mut Problems,
    vector: impl Fn([f32; N]) -> T,
) -> Vec<T> {
    let list = section.arrays(key, problems).map(|at| at.value);
    list.into_iter().flatten().map(vector).collect()
}
