//! The camera of the picture, and how it turns.

use super::*;
use glam::Vec3;

/// Where the camera of the picture is.
fn eye(scene: &Scene) -> Vec3 {
    let passes = scene.passes(scene.size());
    let picture = passes.last().expect("a scene has a picture");
    picture.view.inverse().transform_point3(Vec3::ZERO)
}

#[test]
fn it_turns_around_what_it_looks_at() {
    let mut scene = loaded(
        "[camera]\nposition = [1, 2, -4]\nlook_at = [1, 1, 0]\n[meshes.m]\nshape = \"sphere\"\n\
         [[draw]]\nmesh = \"m\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\n",
    );
    let near = |scene: &Scene, at: Vec3| {
        let eye = eye(scene);
        assert!(eye.distance(at) < 1e-5, "{eye}");
    };
    near(&scene, Vec3::new(1.0, 2.0, -4.0));
    // Four units before the point, at the bottom of a map with +Z on top. Clockwise comes the left side, then the top.
    scene.turn_camera(90.0);
    near(&scene, Vec3::new(-3.0, 2.0, 0.0));
    // Always from where the scene file has it.
    scene.turn_camera(180.0);
    near(&scene, Vec3::new(1.0, 2.0, 4.0));
    scene.turn_camera(0.0);
    near(&scene, Vec3::new(1.0, 2.0, -4.0));
}

#[test]
fn passes_and_draws_tell_their_matrices() {
    let scene = loaded(
        "[camera]\nfov = 90\nnear = 1\nfar = 3\n[meshes.m]\nshape = \"sphere\"\n\
         [[draw]]\nmesh = \"m\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\nworld = { translate = [0, 0, 2] }\n",
    );
    let passes = scene.passes([10, 10]);
    let picture = passes.last().expect("a scene has a picture");
    let world = picture.draws[0].world;
    // One unit aside, two away: at 90 degrees half of the way to the edge. far / (far - near) (2 - near) = 1.5 of w = 2.
    let clip = picture.projection * picture.view * world * Vec3::X.extend(1.0);
    assert!(
        (clip / clip.w - glam::Vec4::new(0.5, 0.0, 0.75, 1.0)).length() < 1e-6,
        "{clip}"
    );
}
