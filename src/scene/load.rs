//! From the bytes of a scene file to a [`Scene`].

use super::draw::{self, Draw, Known, Names};
use super::error::{Problems, SceneError, rules};
use super::files::Files;
use super::resolve::Resolver;
use super::section::{At, Node, Section};
use super::state::surface;
use super::target::{self, Target, draw_list};
use super::texture::{self, Source};
use super::transform::Camera;
use super::{LoadOptions, Scene, TextureEntry, TextureSource, include, mesh};
use crate::diagnostic::{Diagnostic, SourceMap, Span};
use crate::raster;

/// Most meshes, textures, targets or draws of a scene, each.
pub const MAX_ENTRIES: usize = 1024;

/// Most draws that a picture may take, those into render targets included, each as often as it is drawn.
pub const MAX_DRAWS: usize = 1 << 15;

impl Scene {
    /// Reads a scene and everything that it names.
    ///
    /// `name` is what messages call the scene file; `resolver` gives the files whose paths it writes.
    ///
    /// # Errors
    /// [`SceneError`] with every problem that was found, in the scene file and in its listings.
    pub fn load(
        name: &str,
        bytes: &[u8],
        resolver: &dyn Resolver,
        options: &LoadOptions,
    ) -> Result<Self, Box<SceneError>> {
        let loaded = load(name, bytes, resolver, options, |files, problems| {
            read(bytes, files, problems)
        })?;
        Ok(Self {
            sources: loaded.sources,
            warnings: loaded.warnings,
            ..loaded.value
        })
    }
}

/// What was read from a file without an error.
pub(crate) struct Loaded<T> {
    pub(crate) value: T,
    /// The file and the listings.
    pub(crate) sources: SourceMap,
    pub(crate) warnings: Vec<Diagnostic>,
}

/// Reads a file and whatever it names, and collects what is wrong with any of it.
///
/// # Errors
/// [`SceneError`] with every problem, if there is an error among them or `read` gives nothing.
pub(crate) fn load<T>(
    name: &str,
    bytes: &[u8],
    resolver: &dyn Resolver,
    options: &LoadOptions,
    read: impl FnOnce(&mut Files<'_>, &mut Problems) -> Option<T>,
) -> Result<Loaded<T>, Box<SceneError>> {
    let mut files = Files::new(resolver, options);
    let mut problems = Problems::default();
    let (mut sources, mut value) = (SourceMap::new(), None);
    match files.sources.add(name, bytes) {
        Err(error) => {
            // The name alone, so that the message has a place.
            if let Ok(file) = sources.add(name, Vec::new()) {
                problems.error(&rules::LIMIT, file.span(), error.to_string());
            }
        }
        Ok(_) => {
            // The file is the first of the map, so that its offsets are those of the map.
            value = read(&mut files, &mut problems);
            sources = files.sources;
        }
    }
    let refused = problems.any_error();
    let diagnostics = problems.into_sorted();
    match value {
        Some(value) if !refused => Ok(Loaded {
            value,
            sources,
            warnings: diagnostics,
        }),
        _ => Err(Box::new(SceneError {
            sources,
            diagnostics,
        })),
    }
}

fn read(bytes: &[u8], files: &mut Files<'_>, problems: &mut Problems) -> Option<Scene> {
    let whole = problems.span(0..0);
    let table = include::parse(bytes, 0, problems)?;
    let mut root = Section::outermost("the scene file", table, problems);
    let included = include::read(&mut root, files, problems);
    include::merge(&mut root, &included, problems);
    let size = size(&mut root, problems);
    let surface = surface(&mut root, [0.0, 0.0, 0.0, 1.0], problems);
    let time = root.or("time", 0.0, problems);
    let light_direction: [f32; 3] = root.array_or("light_direction", [0.0, -1.0, 0.0], problems);
    let camera = root
        .table("camera", problems)
        .map_or_else(Camera::default, |table| Camera::read(table, problems));

    let (mesh_names, mesh_sections) = entries(&mut root, "meshes", problems);
    let meshes: Vec<_> = mesh_sections
        .into_iter()
        .map(|section| mesh::read(section?, files, problems))
        .collect();
    let (texture_names, texture_sections) = entries(&mut root, "textures", problems);
    let textures: Vec<_> = texture_sections
        .into_iter()
        .map(|section| texture::read(section?, files, problems))
        .collect();
    let (target_names, target_sections) = entries(&mut root, "targets", problems);
    let (draw_names, draw_sections) = draw_entries(&mut root, problems);
    let known = Known {
        meshes: &mesh_names,
        textures: &texture_names,
        targets: &target_names,
    };
    let draws: Vec<Option<Draw>> = draw_sections
        .into_iter()
        .map(|(name, section)| draw::read(name, section, &known, files, problems))
        .collect();
    let mut target_titles: Vec<_> = target_names.iter().collect();
    target_titles.sort_by_key(|(_, number)| **number);
    let targets: Vec<Option<Target>> = target_titles
        .into_iter()
        .zip(target_sections)
        .map(|((name, _), section)| {
            target::read(name.clone(), section?, &draw_names, files, problems)
        })
        .collect();
    let picture = match root.node("draws") {
        Some(node) => draw_list(node, &draw_names, problems),
        None => (0..draws.len()).collect(),
    };
    root.finish(problems);

    let sources = texture_sources(textures, &texture_names, &target_names, &targets, problems);
    // Numbers are good only if nothing has been left out.
    let meshes = all(meshes);
    let (draws, targets, sources) = (all(draws), all(targets), all(sources));
    let (Some(meshes), Some(draws), Some(targets), Some(sources)) =
        (meshes, draws, targets, sources)
    else {
        return None;
    };
    let mut names: Vec<_> = texture_names.into_iter().collect();
    names.sort_by_key(|(_, number)| *number);
    let textures = names
        .into_iter()
        .zip(sources)
        .map(|((name, _), source)| TextureEntry { name, source })
        .collect();
    let mut scene = Scene {
        size: size?,
        surface,
        time,
        light_direction: light_direction.into(),
        camera,
        meshes,
        textures,
        targets,
        order: Vec::new(),
        draws,
        picture,
        sources: SourceMap::new(),
        warnings: Vec::new(),
    };
    if !few_draws(&scene, whole, problems) {
        return None;
    }
    check_indices(&scene, problems);
    let reads = |number: usize| scene.targets_read_by(&scene.targets[number].draws);
    scene.order = target::order(&scene.targets, reads, problems);
    scene.check_meanings(problems);
    Some(scene)
}

/// Looks up what textures are made of.
fn texture_sources(
    textures: Vec<Option<Source>>,
    texture_names: &Names,
    target_names: &Names,
    targets: &[Option<Target>],
    problems: &mut Problems,
) -> Vec<Option<TextureSource>> {
    let target = |name: &At<String>, problems: &mut Problems| {
        draw::find(target_names, "render target", name, problems)
    };
    // Those that are made of others, in a first round: they look at what the others are.
    let derived: Vec<Option<TextureSource>> = textures
        .iter()
        .map(|source| {
            let Some(Source::Irradiance { of, edge }) = source else {
                return None;
            };
            let number = draw::find(texture_names, "texture", of, problems)?;
            match textures.get(number)?.as_ref()? {
                Source::Loaded(cube) => {
                    let map = texture::made(cube.irradiance(*edge), of.span, problems)?;
                    Some(TextureSource::Loaded(map))
                }
                Source::Target(name) => {
                    let number = target_names.get(&name.value)?;
                    if targets.get(*number)?.as_ref()?.faces() == 6 {
                        let (target, edge) = (*number, *edge);
                        return Some(TextureSource::Irradiance { target, edge });
                    }
                    let message = format!("`{}` is not a cube", of.value);
                    problems.error(&rules::CONTENT, of.span, message);
                    None
                }
                Source::Irradiance { .. } => {
                    let message = format!("`{}` is a diffuse cube map already", of.value);
                    problems.error(&rules::CONTENT, of.span, message);
                    None
                }
            }
        })
        .collect();
    (textures.into_iter().zip(derived))
        .map(|(source, derived)| match source? {
            Source::Loaded(texture) => Some(TextureSource::Loaded(texture)),
            Source::Target(name) => target(&name, problems).map(TextureSource::Target),
            Source::Irradiance { .. } => derived,
        })
        .collect()
}

/// Whether a picture takes no more draws than [`MAX_DRAWS`], those into targets included.
fn few_draws(scene: &Scene, whole: Span, problems: &mut Problems) -> bool {
    let into_targets = scene.targets.iter().map(|t| t.faces() * t.draws.len());
    let count = into_targets.fold(scene.picture.len(), usize::saturating_add);
    if count <= MAX_DRAWS {
        return true;
    }
    let message =
        format!("a picture of this scene takes {count} draws; at most {MAX_DRAWS} are allowed");
    problems.error(&rules::LIMIT, whole, message);
    false
}

/// Reports indices of draws that name vertices which their meshes do not have.
fn check_indices(scene: &Scene, problems: &mut Problems) {
    for draw in &scene.draws {
        let (Some(indices), Some(mesh)) = (&draw.indices, scene.meshes.get(draw.mesh)) else {
            continue;
        };
        let count = mesh.vertex_count();
        if let Some(index) = indices.value.iter().find(|index| **index as usize >= count) {
            let message = format!("`indices` names vertex {index}; the mesh has {count}, from 0");
            problems.error(&rules::CONTENT, indices.span, message);
        }
    }
}

/// Everything, unless something is missing.
fn all<T>(list: Vec<Option<T>>) -> Option<Vec<T>> {
    list.into_iter().collect()
}

fn size(root: &mut Section<'_>, problems: &mut Problems) -> Option<[u32; 2]> {
    let Some(At { value, span }) = root.array::<u32, 2>("size", problems) else {
        return Some([640, 480]);
    };
    let [width, height] = value;
    if value
        .iter()
        .all(|side| (1..=raster::Target::MAX_SIDE).contains(side))
        && u64::from(width) * u64::from(height) <= raster::Target::MAX_PIXELS
    {
        return Some(value);
    }
    let message = format!(
        "a picture of {width} by {height} pixels: each side is 1 to {}, and {} pixels are the most",
        raster::Target::MAX_SIDE,
        raster::Target::MAX_PIXELS
    );
    problems.error(&rules::VALUE, span, message);
    None
}

/// The tables of a table whose keys are names, in the order of the file.
fn entries<'i>(
    root: &mut Section<'i>,
    key: &'static str,
    problems: &mut Problems,
) -> (Names, Vec<Option<Section<'i>>>) {
    let mut names = Names::new();
    let mut sections = Vec::new();
    let Some(mut table) = root.table(key, problems) else {
        return (names, sections);
    };
    for node in table.rest() {
        if too_many(names.len(), key, &node, problems) {
            break;
        }
        names.insert(node.key.clone(), sections.len());
        let title = format!("[{key}.{}]", node.key);
        sections.push(node.into_section(title, problems));
    }
    (names, sections)
}

fn too_many(count: usize, key: &str, node: &Node<'_>, problems: &mut Problems) -> bool {
    if count < MAX_ENTRIES {
        return false;
    }
    let message = format!("`{key}` has more than {MAX_ENTRIES} entries");
    problems.error(&rules::LIMIT, node.key_span, message);
    true
}

/// The tables of `[[draw]]` with their names; a draw without one is called by its number, from 1.
fn draw_entries<'i>(
    root: &mut Section<'i>,
    problems: &mut Problems,
) -> (Names, Vec<(String, Section<'i>)>) {
    let mut names = Names::new();
    let mut sections: Vec<(String, Section<'i>)> = Vec::new();
    let Some(node) = root.node("draw") else {
        root.missing("at least one `[[draw]]`", problems);
        return (names, sections);
    };
    let list = node.into_list("a list of tables, `[[draw]]`", problems);
    for (node, number) in list.into_iter().zip(1..) {
        if too_many(sections.len(), "draw", &node, problems) {
            break;
        }
        let Some(mut section) = node.into_section(format!("draw {number}"), problems) else {
            continue;
        };
        let given = section.at::<String>("name", problems);
        let span = given.as_ref().map_or(section.span, |at| at.span);
        let name = given.map_or_else(|| number.to_string(), |at| at.value);
        section.title = format!("draw `{name}`");
        if names.insert(name.clone(), sections.len()).is_some() {
            let message = format!("there are two draws called `{name}`");
            problems.error(&rules::TWICE, span, message);
        }
        sections.push((name, section));
    }
    (names, sections)
}
