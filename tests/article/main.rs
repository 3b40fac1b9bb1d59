//! The article's claim, measured: the corrected lookup meets the room where the ray through the pane meets it.
#![allow(clippy::expect_used, reason = "a test that cannot go on has failed")]

use glam::{Mat4, Vec3, Vec4};
use std::path::Path;
use texcrd::exec::{Environment, Stage};
use texcrd::kernel::Slot;
use texcrd::raster::{DrawCall, PixelProgram, Viewport, cover, shade_vertices};
use texcrd::scene::{DirectoryResolver, LoadOptions, PreparedDraw, Scene};

/// How far apart the pixels are that are measured.
const STEP: usize = 8;

fn scene(file: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("asm/stained_glass");
    let bytes = std::fs::read(folder.join(file)).expect("the scene file is there");
    let resolver = DirectoryResolver::new(folder);
    match Scene::load(file, &bytes, &resolver, &LoadOptions::default()) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

/// A matrix from the constant registers that hold it: Direct3D programs uploaded it transposed, a register a column of
/// the row-vector convention, which is a row of ours.
fn matrix(constants: &[[f32; 4]], first: usize) -> Mat4 {
    let row = |i: usize| Vec4::from(constants[first + i]);
    Mat4::from_cols(row(0), row(1), row(2), row(3)).transpose()
}

/// The triangles of a draw in the world.
fn triangles(draw: &PreparedDraw<'_>) -> Vec<[Vec3; 3]> {
    // room.vsh has the world matrix in c4 to c7.
    let world = matrix(&draw.vertex_constants, 4);
    let at = |i: u32| world.transform_point3(draw.mesh.positions()[i as usize]);
    (draw.mesh.indices().chunks_exact(3))
        .map(|t| [at(t[0]), at(t[1]), at(t[2])])
        .collect()
}

/// Where a ray first meets a triangle from either side, as a multiple of the direction (Möller and Trumbore).
fn hit(origin: Vec3, direction: Vec3, [a, b, c]: &[Vec3; 3]) -> Option<f32> {
    let (ab, ac) = (b - a, c - a);
    let across = direction.cross(ac);
    let determinant = ab.dot(across);
    if determinant.abs() < 1e-12 {
        return None;
    }
    let to_origin = origin - a;
    let u = to_origin.dot(across) / determinant;
    let other = to_origin.cross(ab);
    let v = direction.dot(other) / determinant;
    let t = ac.dot(other) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then_some(t)
}

/// The mean angle in degrees between the direction in which the pixel shader looks the room up and the direction from
/// the centre of the cube map to the point that the ray from the eye through the pane meets in the room.
fn mean_angle(scene: &Scene) -> f32 {
    let size = scene.size();
    let passes = scene.passes(size);
    let picture = passes.last().expect("a scene has a picture");
    let pane = (picture.draws.iter().find(|d| d.name == "pane")).expect("a draw is the pane");
    // What the cube map holds is what can be looked up.
    let in_cube = &passes.first().expect("the cube map is drawn first").draws;
    let room: Vec<_> = in_cube.iter().flat_map(triangles).collect();
    assert!(room.len() > 1000, "the room and the chest");

    let environment = Environment {
        constants: pane.vertex_constants.clone(),
        ..Default::default()
    };
    let vertices = shade_vertices(
        &pane.vertex.kernel,
        &pane.vertex.plan,
        &environment,
        pane.mesh.vertex_count(),
        |vertex, register| pane.input(vertex, register),
    );
    let call = DrawCall {
        viewport: Viewport::full(size[0], size[1]),
        state: &pane.state,
        topology: pane.topology,
        vertices: &vertices,
        indices: pane.indices(),
    };
    // r2 at the end of the first phase is what `texld r2, r2` samples the cube map with. The normal map is sampled as in
    // the picture; the other stages play no part in it.
    let environment = Environment {
        constants: pane.pixel_constants.clone(),
        stages: std::array::from_fn(|i| Stage {
            texture: pane.stages[i]
                .texture
                .and_then(|t| match &scene.textures()[t].source {
                    texcrd::scene::TextureSource::Loaded(texture) => Some(texture),
                    _ => None,
                }),
            sampler: pane.stages[i].sampler,
            bump: pane.stages[i].bump,
        }),
    };
    let first_phase = pane
        .pixel
        .program
        .instructions()
        .position(|i| i.opcode == texcrd::isa::Opcode::Phase)
        .expect("the listing has two phases");
    let shader = PixelProgram {
        kernel: &pane.pixel.kernel,
        environment: &environment,
    };
    let looked_up = Slot::temp(2).expect("r2");
    let object = matrix(&pane.vertex_constants, 12);
    let center = object.transform_point3(Vec3::ZERO);
    let eye = object.transform_point3(Vec4::from(pane.vertex_constants[28]).truncate());
    let to_world = object * matrix(&pane.vertex_constants, 16).inverse();

    let (mut sum, mut count) = (0.0, 0);
    for y in (0..size[1]).step_by(STEP) {
        for x in (0..size[0]).step_by(STEP) {
            let fragments = cover(&call, (size[0], size[1]), (x, y)).expect("the draw is sound");
            for fragment in fragments {
                let trace = shader.trace(&fragment.batch, fragment.lane).trace;
                let [r, g, b, _] = (trace.changes.iter())
                    .rfind(|write| write.slot == looked_up && write.instruction < first_phase)
                    .expect("the first phase writes r2")
                    .after;
                // The pixel centre on the screen, back through the projection.
                let at = Vec3::new(
                    2.0 * x as f32 / size[0] as f32 - 1.0,
                    1.0 - 2.0 * y as f32 / size[1] as f32,
                    0.5,
                );
                let ray = to_world.project_point3(at) - eye;
                let on_pane = -(eye.z - center.z) / ray.z;
                let beyond = |t: &f32| *t > on_pane;
                let nearest = (room.iter().filter_map(|t| hit(eye, ray, t)))
                    .filter(beyond)
                    .reduce(f32::min)
                    .expect("a room has no holes");
                let truth = eye + nearest * ray - center;
                sum += Vec3::new(r, g, b).angle_between(truth).to_degrees();
                count += 1;
            }
        }
    }
    assert!(
        count > 1000,
        "the pane covers a good part of the picture, not {count} pixels"
    );
    sum / count as f32
}

/// Figures 1 and 5 in numbers. What the article promises is that the correction makes what is seen through the pane match
/// what is beside it; here it must take away at least three quarters of the error.
#[test]
fn the_correction_finds_the_room() {
    let without = mean_angle(&scene("figure1.toml"));
    let with = mean_angle(&scene("figure5.toml"));
    println!(
        "mean angle between lookup and truth: {without:.2} degrees without the correction, {with:.2} with it"
    );
    assert!(without > 5.0, "{without}");
    assert!(with < without / 4.0, "{with} against {without}");
}
