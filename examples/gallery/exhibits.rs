//! What hangs in the gallery: the folders of `asm/`, their scenes, and what is measured of them.

use crate::measure::{Form, Look, Subject};
use crate::truth::Law;
use glam::DVec3;

/// A technique in one scene.
pub(crate) struct Piece {
    /// The folder below `asm/`.
    pub(crate) folder: &'static str,
    /// The scene file in it, without `.toml`.
    pub(crate) scene: &'static str,
    /// What it is, on pictures and in the table.
    pub(crate) title: &'static str,
    /// How it is measured; showcases are not.
    pub(crate) subject: Option<Subject>,
    /// Whether directions are to be compared with those of the light behind the surface, because the technique takes the
    /// room for endless; if not, with those of what the light comes from.
    pub(crate) endless: bool,
}

/// Where the reflectors stand, and the cube map of the room is taken from.
const CENTER: DVec3 = DVec3::new(0.0, 1.6, 0.0);

const BALL: Subject = Subject {
    draw: "ball",
    left_out: &[],
    looks: &[(2, Look::Cube)],
    form: Form::Ball { radius: 0.75 },
    law: Law::Mirror,
    center: CENTER,
};

const WATER: Subject = Subject {
    law: Law::Glass { index: 1.33 },
    ..BALL
};

const MIRROR: Subject = Subject {
    draw: "mirror",
    left_out: &["frame"],
    form: Form::Mesh { normals: None },
    ..BALL
};

/// The window of the article, in a room of its own.
const WINDOW: Subject = Subject {
    draw: "pane",
    left_out: &["frame"],
    law: Law::Pane,
    center: DVec3::new(0.0, 2.0, 0.0),
    ..MIRROR
};

/// Looks up the environment in its first stage.
const FIRST: Subject = Subject {
    looks: &[(0, Look::Cube)],
    ..MIRROR
};

/// Looks up the environment in its fourth stage.
const THIRD: Subject = Subject {
    looks: &[(3, Look::Cube)],
    ..MIRROR
};

/// What the mirrored camera saw.
const MIRRORED: Look = Look::Flat("mirrored");

const POOL: Subject = Subject {
    draw: "pool",
    left_out: &["floor"],
    ..MIRROR
};

const RIPPLED: Subject = Subject {
    looks: &[(1, MIRRORED)],
    form: Form::Mesh { normals: Some(0) },
    ..POOL
};

/// The ball that stands in the floor.
const STANDING: Subject = Subject {
    center: DVec3::new(0.0, 0.6, 0.0),
    ..BALL
};

const fn piece(
    folder: &'static str,
    scene: &'static str,
    title: &'static str,
    endless: bool,
    subject: Subject,
) -> Piece {
    Piece {
        folder,
        scene,
        title,
        subject: Some(subject),
        endless,
    }
}

/// A piece that is shown, and not measured.
const fn shown(folder: &'static str, scene: &'static str, title: &'static str) -> Piece {
    Piece {
        folder,
        scene,
        title,
        subject: None,
        endless: false,
    }
}

/// All of them, in the order of the gallery.
pub(crate) const PIECES: &[Piece] = &[
    shown("cube_map", "scene", "a cube map of the room"),
    piece(
        "reflection",
        "per_vertex",
        "reflection per vertex",
        true,
        Subject {
            looks: &[(0, Look::Cube)],
            ..BALL
        },
    ),
    piece(
        "reflection",
        "per_pixel",
        "reflection per pixel, ps.1.4",
        true,
        BALL,
    ),
    piece(
        "reflection",
        "vspec",
        "reflection by texm3x3vspec",
        true,
        Subject {
            looks: &[(3, Look::Cube)],
            ..BALL
        },
    ),
    piece(
        "refraction",
        "snell",
        "Snell's law per vertex",
        true,
        Subject {
            looks: &[(0, Look::Cube)],
            ..WATER
        },
    ),
    piece(
        "refraction",
        "lrp",
        "refraction by lrp per pixel",
        true,
        WATER,
    ),
    piece(
        "refraction",
        "fitted",
        "refraction, fitted line",
        true,
        WATER,
    ),
    piece(
        "dispersion",
        "scene",
        "Fresnel and dispersion",
        true,
        Subject {
            looks: &[
                (4, Look::Cube),
                (5, Look::Cube),
                (0, Look::Cube),
                (3, Look::Cube),
            ],
            draw: "glass",
            form: Form::Mesh { normals: None },
            law: Law::Dispersion {
                indices: [1.27, 1.33, 1.39],
            },
            ..BALL
        },
    ),
    shown("stained_glass", "scene", "stained glass"),
    piece("stained_glass", "figure1", "window, plain", false, WINDOW),
    piece("stained_glass", "figure5", "window, Brennan", false, WINDOW),
    piece("correction", "mirror_plain", "mirror, plain", false, MIRROR),
    piece("correction", "mirror", "mirror, Brennan", false, MIRROR),
    piece("correction", "ball_plain", "ball, plain", false, BALL),
    piece("correction", "ball", "ball, Brennan", false, BALL),
    piece("sphere", "per_vertex", "sphere per vertex", false, FIRST),
    piece(
        "sphere",
        "one_pass",
        "sphere, root per pixel, ps.1.1",
        false,
        THIRD,
    ),
    piece(
        "sphere",
        "per_pixel",
        "sphere, two passes of ps.1.4",
        false,
        MIRROR,
    ),
    piece("sphere", "dome_plain", "round room, plain", false, MIRROR),
    piece(
        "sphere",
        "dome_correction",
        "round room, Brennan",
        false,
        MIRROR,
    ),
    piece(
        "sphere",
        "dome_per_vertex",
        "round room, sphere per vertex",
        false,
        FIRST,
    ),
    piece(
        "sphere",
        "dome_one_pass",
        "round room, root per pixel",
        false,
        THIRD,
    ),
    piece(
        "sphere",
        "dome_per_pixel",
        "round room, two passes",
        false,
        MIRROR,
    ),
    piece(
        "planar",
        "perfect",
        "still pool",
        false,
        Subject {
            looks: &[(0, MIRRORED)],
            ..POOL
        },
    ),
    piece("planar", "offset", "rippled, pushed", false, RIPPLED),
    piece("planar", "solved", "rippled, solved", false, RIPPLED),
    piece(
        "impostors",
        "plain",
        "environment map only",
        false,
        STANDING,
    ),
    piece(
        "impostors",
        "impostors",
        "impostors",
        false,
        Subject {
            looks: &[
                (0, Look::Cube),
                (2, Look::Flat("floor")),
                (4, Look::Flat("statue")),
            ],
            ..STANDING
        },
    ),
    shown("showcases", "bumpenv", "texbeml, ps.1.1"),
    shown("showcases", "toon", "texdp3tex, ps.1.2"),
    shown("showcases", "depth_sprites", "texm3x2depth, ps.1.3"),
    shown("showcases", "skinning", "a0.x, vs.1.1"),
    shown("showcases", "points", "oPts, vs.1.1"),
    shown("showcases", "fog", "oFog, vs.1.1"),
];

/// The pieces that open the project's page, by folder and scene, with their captions.
pub(crate) const CONTACT: &[[&str; 3]] = &[
    ["stained_glass", "scene", "stained glass"],
    ["cube_map", "scene", "cube map"],
    ["reflection", "per_pixel", "reflection"],
    ["refraction", "fitted", "refraction"],
    ["dispersion", "scene", "Fresnel and dispersion"],
    ["correction", "mirror", "Brennan's correction"],
    ["sphere", "dome_per_pixel", "exact sphere"],
    ["planar", "solved", "rippled planar mirror"],
    ["impostors", "impostors", "impostors"],
    ["showcases", "bumpenv", "texbeml"],
    ["showcases", "toon", "texdp3tex"],
    ["showcases", "depth_sprites", "texm3x2depth"],
    ["showcases", "skinning", "a0.x"],
    ["showcases", "points", "oPts"],
    ["showcases", "fog", "oFog"],
];

/// Folders that have pictures of their own.
pub(crate) const WITHOUT_SHEET: &[&str] = &["stained_glass"];

/// Folders whose errors are plotted by the angle of incidence.
pub(crate) const PLOTTED: &[&str] = &["refraction"];
