//! The scene that is drawn: the article's room with its window, which turns.

use std::path::Path;

use glam::{Mat4, Vec4};
use texcrd::gpu::{Device, Renderer};
use texcrd::scene::{DirectoryResolver, LoadOptions, Pass, PreparedDraw, Scene};
use texcrd::texture::Texture;

use crate::Failure;

/// How fast the window turns, in radians a second.
const SPEED: f32 = 0.7;

/// The scene with its textures.
pub(crate) struct Glass {
    pub(crate) scene: Scene,
    /// By the numbers that the stages of a draw hold.
    pub(crate) textures: Vec<Option<Texture>>,
}

impl Glass {
    /// Reads the scene, and has the library draw the cube map of the room that the glass shows.
    pub(crate) fn load() -> Result<Self, Failure> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../asm/stained_glass");
        let path = folder.join("scene.toml");
        let bytes = std::fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let resolver = DirectoryResolver::new(&folder);
        let scene = Scene::load("scene.toml", &bytes, &resolver, &LoadOptions::default())?;
        let device = Device::open(None)?;
        let textures = Renderer::new(&device).textures(&scene)?;
        Ok(Self { scene, textures })
    }

    /// What there is to draw for a picture of this size at this time.
    pub(crate) fn picture(&self, size: [u32; 2], seconds: f32) -> Option<Pass<'_>> {
        // Passes into render targets come first; their textures are there already.
        let mut picture = self.scene.passes(size).pop()?;
        let turn = Mat4::from_rotation_y(seconds * SPEED);
        for draw in &mut picture.draws {
            spin(draw, turn);
        }
        Some(picture)
    }
}

/// Turns what is part of the window about its own upright axis, through the constants that its vertex shader has matrices
/// in. `room.vsh`: c0 world, view and projection, c4 world. `stained_glass.vsh`: c12 and c20 world, c16 world, view and
/// projection, c28 the camera in object space.
fn spin(draw: &mut PreparedDraw<'_>, turn: Mat4) {
    let (matrices, points): (&[usize], &[usize]) = match draw.name {
        "frame" => (&[0, 4], &[]),
        "pane" => (&[12, 16, 20], &[28]),
        _ => return,
    };
    // Registers hold what a vertex is multiplied with by `dp4`: the rows of matrices for column vectors, as `glam` has
    // them. The turn comes before all that they do.
    for &first in matrices {
        if let Some(rows) = draw.vertex_constants.get_mut(first..first + 4) {
            let [a, b, c, d] = [0, 1, 2, 3].map(|row: usize| Vec4::from_array(rows[row]));
            let turned = Mat4::from_cols(a, b, c, d).transpose() * turn;
            for (row, register) in rows.iter_mut().enumerate() {
                *register = turned.row(row).to_array();
            }
        }
    }
    for &point in points {
        if let Some(register) = draw.vertex_constants.get_mut(point) {
            *register = (turn.transpose() * Vec4::from_array(*register)).to_array();
        }
    }
}
