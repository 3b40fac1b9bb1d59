//! How far a scene is from the truth: the directions that its pixel shader looks up, and its picture.

use crate::probe::{Lookup, seen};
use crate::tree::Ray;
use crate::truth::{Body, Law, Path};
use crate::world::World;
use glam::{DMat4, DVec3};
use image::{Rgba, RgbaImage};
use rayon::prelude::*;
use texcrd::raster::Target;
use texcrd::scene::{Output, Pass, Rendering};

/// Rays along each side of a pixel of the traced picture.
const RAYS: u32 = 3;

/// What a stage shows that a shader looks up.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Look {
    /// A cube map of the room: coordinates are a direction from its centre.
    Cube,
    /// A flat picture from the camera of a render target, by its name: coordinates are a place on it.
    Flat(&'static str),
}

/// The body, as an exhibit describes it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Form {
    Ball {
        radius: f64,
    },
    /// The triangles of the draw. `normals`: the stage of its normal map.
    Mesh {
        normals: Option<usize>,
    },
}

/// What is measured of a scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Subject {
    /// The draw that reflects or refracts.
    pub(crate) draw: &'static str,
    /// The draws that rays pass through beside it.
    pub(crate) left_out: &'static [&'static str],
    /// The stages that are looked up. One for each path of the law in its order; or several for one path, of which the
    /// last counts whose texel is not transparent.
    pub(crate) looks: &'static [(u8, Look)],
    pub(crate) form: Form,
    pub(crate) law: Law,
    /// Where the cube map was taken from, and where the ball is.
    pub(crate) center: DVec3,
}

/// Angles in degrees.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Angles {
    pub(crate) mean: f64,
    pub(crate) worst: f64,
}

/// What came out.
pub(crate) struct Measured {
    /// Between the direction looked up and that of the light behind the surface: what it would be in an endless room.
    pub(crate) ray: Angles,
    /// Between the direction looked up and that of the point of the room that the light comes from.
    pub(crate) room: Angles,
    /// The mean difference of the pixels to those of the traced picture, channel by channel, in parts of full brightness.
    pub(crate) difference: f64,
    /// Angle of incidence and error of [`Self::ray`] in degrees, pixel by pixel.
    pub(crate) by_incidence: Vec<[f64; 2]>,
    pub(crate) traced: RgbaImage,
}

/// Rays through places of a picture.
struct Camera {
    to_world: DMat4,
    size: [f64; 2],
}

impl Camera {
    fn new(pass: &Pass<'_>) -> Self {
        let (view, projection) = (pass.view.as_dmat4(), pass.projection.as_dmat4());
        Self {
            to_world: (projection * view).inverse(),
            size: pass.size.map(f64::from),
        }
    }

    /// The ray through a place in pixels; their centres are whole numbers. It begins at the near plane.
    fn ray(&self, x: f64, y: f64) -> Ray {
        let at = |depth: f64| {
            let [width, height] = self.size;
            let clip = DVec3::new(2.0 * x / width - 1.0, 1.0 - 2.0 * y / height, depth);
            self.to_world.project_point3(clip)
        };
        Ray {
            origin: at(0.0),
            direction: (at(1.0) - at(0.0)).normalize(),
        }
    }
}

/// Measures a scene that was rendered.
///
/// # Errors
/// A sentence for people if the scene does not have what the subject names.
pub(crate) fn measure(rendering: &Rendering<'_>, subject: &Subject) -> Result<Measured, String> {
    let Subject { draw, center, .. } = *subject;
    let missing = |what: &str| format!("the scene has no {what}");
    let pass = (rendering.pass(Output::Picture)).ok_or_else(|| missing("picture"))?;
    let camera = Camera::new(pass);
    let stages: Vec<u8> = subject.looks.iter().map(|(stage, _)| *stage).collect();
    let seen = seen(rendering, draw, &stages).ok_or_else(|| missing(draw))?;
    let room = World::new(rendering, |name| {
        name != draw && !subject.left_out.contains(&name)
    });
    let number = (pass.draws.iter()).position(|prepared| prepared.name == draw);
    let shaded = number.and_then(|number| rendering.shaded(Output::Picture, number));
    let shaded = shaded.ok_or_else(|| missing(draw))?;
    let body = match subject.form {
        Form::Ball { radius } => Body::Ball { center, radius },
        Form::Mesh { normals } => Body::Mesh {
            surface: World::new(rendering, |name| name == draw),
            normals: normals.and_then(|stage| shaded.environment().stages.get(stage)),
        },
    };
    let cameras = subject.looks.iter().map(|(_, look)| match look {
        Look::Cube => Ok(None),
        Look::Flat(target) => (rendering.passes().iter())
            .find(|pass| match pass.output {
                Output::Target { target: number, .. } => {
                    (rendering.scene().target(number)).is_some_and(|info| info.name == *target)
                }
                Output::Picture => false,
            })
            .map(|pass| Some(Camera::new(pass)))
            .ok_or_else(|| missing(target)),
    });
    let cameras = cameras.collect::<Result<Vec<_>, _>>()?;
    let judge = Judge {
        subject,
        room: &room,
        cameras: &cameras,
    };

    // Each pixel through its centre: angles. Then with several rays: its true colour.
    let pixels: Vec<_> = (seen.par_iter())
        .map(|seen| {
            let [x, y] = seen.pixel.map(f64::from);
            let ray = camera.ray(x, y);
            let met = body.meet(&ray);
            let errors = met.map(|met| {
                let incidence = (-ray.direction.dot(met.normal)).clamp(-1.0, 1.0).acos();
                let paths = subject.law.paths(&body, &ray, &met);
                (
                    incidence.to_degrees(),
                    judge.errors(met.point, &paths, &seen.lookups),
                )
            });
            let mut color = DVec3::ZERO;
            for part in 0..RAYS * RAYS {
                let within = |part: u32| (f64::from(part) + 0.5) / f64::from(RAYS) - 0.5;
                let ray = camera.ray(x + within(part % RAYS), y + within(part / RAYS));
                color += judge.color(&body, &ray);
            }
            (seen.pixel, errors, color / f64::from(RAYS * RAYS))
        })
        .collect();

    let mut traced = rendering.picture().to_image();
    let mut measured = Sums::default();
    let mut by_incidence = Vec::new();
    for (pixel, errors, color) in pixels {
        measured.picture(rendering.picture(), pixel, color);
        let [r, g, b] = (color * 255.0 + 0.5).to_array().map(|value| value as u8);
        traced.put_pixel(pixel[0], pixel[1], Rgba([r, g, b, 255]));
        if let Some((incidence, errors)) = errors {
            for error in errors {
                by_incidence.push([incidence, error.ray]);
                measured.add(error);
            }
        }
    }
    if measured.count == 0 {
        return Err(format!("`{draw}` is not seen"));
    }
    let (count, pixels) = (measured.count as f64, measured.pixels as f64);
    let mean = |angles: Angles| Angles {
        mean: angles.mean / count,
        ..angles
    };
    Ok(Measured {
        ray: mean(measured.ray),
        room: mean(measured.room),
        difference: measured.difference / pixels / 3.0,
        by_incidence,
        traced,
    })
}

/// Errors of one lookup, in degrees.
#[derive(Clone, Copy)]
struct Error {
    ray: f64,
    room: f64,
}

#[derive(Default)]
struct Sums {
    /// [`Angles::mean`] is a sum here.
    ray: Angles,
    room: Angles,
    count: usize,
    difference: f64,
    pixels: usize,
}

impl Sums {
    fn add(&mut self, error: Error) {
        self.count += 1;
        for (angles, error) in [(&mut self.ray, error.ray), (&mut self.room, error.room)] {
            angles.mean += error;
            angles.worst = angles.worst.max(error);
        }
    }

    fn picture(&mut self, picture: &Target, [x, y]: [u32; 2], color: DVec3) {
        let [r, g, b, _] = picture
            .color(x, y)
            .unwrap_or_default()
            .map(|v| f64::from(v) / 255.0);
        self.difference += (DVec3::new(r, g, b) - color).abs().element_sum();
        self.pixels += 1;
    }
}

struct Judge<'a> {
    subject: &'a Subject,
    room: &'a World<'a>,
    cameras: &'a [Option<Camera>],
}

impl Judge<'_> {
    /// The true colour that a ray brings.
    fn color(&self, body: &Body<'_>, ray: &Ray) -> DVec3 {
        let seen = |ray: &Ray| {
            self.room
                .hit(ray)
                .map_or(DVec3::ZERO, |hit| self.room.color(&hit))
        };
        match body.meet(ray) {
            None => seen(ray),
            Some(met) => (self.subject.law.paths(body, ray, &met).iter())
                .map(|path| path.weight * seen(&path.last))
                .sum(),
        }
    }

    /// The errors of what was looked up for light that goes these ways from a point of the body. What leaves the room has none.
    fn errors(&self, point: DVec3, paths: &[Path], lookups: &[Lookup]) -> Vec<Error> {
        let directions = lookups.iter().zip(self.cameras).map(|(lookup, camera)| {
            let at = lookup.at.map(f64::from);
            match camera {
                None => Some(self.subject.center + DVec3::from(at)),
                Some(_) if lookup.alpha < 0.5 => None,
                Some(camera) => {
                    // Texels are looked up by their centres, pixels are drawn at whole numbers.
                    let [width, height] = camera.size;
                    let ray = camera.ray(at[0] * width - 0.5, at[1] * height - 0.5);
                    self.room.hit(&ray).map(|hit| hit.point)
                }
            }
        });
        let directions: Vec<_> = directions.collect();
        // Seen from where the cube map was taken; where there is none, from the surface.
        let flat = self.cameras.iter().all(Option::is_some);
        let from = if flat { point } else { self.subject.center };
        let error = |path: &Path, place: DVec3| {
            let end = self.room.hit(&path.last)?.point;
            Some(Error {
                ray: (place - from).angle_between(path.first).to_degrees(),
                room: (place - from).angle_between(end - from).to_degrees(),
            })
        };
        if let [path] = paths {
            // The shader leaves out what lies behind the surface.
            let ahead = |place: &DVec3| flat || (place - point).dot(path.first) > 0.0;
            let places = directions.into_iter().zip(self.cameras);
            let place = places
                .filter_map(|(place, camera)| {
                    place.filter(|place| camera.is_none() || ahead(place))
                })
                .next_back();
            return place
                .and_then(|place| error(path, place))
                .into_iter()
                .collect();
        }
        let pairs = paths.iter().zip(directions);
        pairs
            .filter_map(|(path, place)| error(path, place?))
            .collect()
    }
}
