//! Pictures made by formula: the textures of the scenes. Each generator is a row of [`GENERATORS`].
//!
//! All are deterministic: the same parameters give the same bytes, on every machine whose `f32` functions agree, and with
//! any number of threads.

mod canvas;
mod chest;
mod glass;
mod height;
mod noise;
#[cfg(test)]
mod tests;
mod wall;

use std::fmt;

use image::RgbaImage;

use canvas::{Color, blend, paint, plot, rgb};

pub use height::HeightField;

/// Most texels along one side of a generated picture.
pub const MAX_SIZE: u32 = 4096;

/// Most cells (bricks, squares, boards) along one side of a generated picture.
pub const MAX_CELLS: u32 = 256;

/// A request for a generated picture, as a scene file writes it: the generator's name and what differs from its defaults.
#[derive(Debug, Clone, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// A name of [`GENERATORS`].
    pub generate: String,
    /// Width and height in texels, 1 to [`MAX_SIZE`] each. Default 512 × 512.
    #[serde(default)]
    pub size: Option<[u32; 2]>,
    /// Chooses among pictures of the same kind. Default 1.
    #[serde(default)]
    pub seed: Option<u32>,
    /// Cells across and down, 1 to [`MAX_CELLS`] each; what a cell is says the generator.
    #[serde(default)]
    pub cells: Option<[u32; 2]>,
    /// The generator's colours from the first on, red, green, blue, alpha, each 0 to 1; those left out keep their default.
    #[serde(default)]
    pub colors: Vec<[f32; 4]>,
    /// How high the relief of a normal map is, in parts of the picture's shorter side, 0 to 1.
    #[serde(default)]
    pub relief: Option<f32>,
}

/// Why a picture could not be made. Its `Display` text is a sentence for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GenerateError {
    /// There is no generator of that name.
    Unknown(String),
    /// A parameter is out of range, or the generator has no such parameter.
    Parameter {
        /// The generator.
        generator: &'static str,
        /// The parameter.
        name: &'static str,
        /// What is wrong and what is allowed.
        rule: String,
    },
}

impl fmt::Display for GenerateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name) => {
                let names: Vec<&str> = GENERATORS.iter().map(|g| g.name).collect();
                write!(
                    f,
                    "there is no texture generator `{name}`; there are {}",
                    names.join(", ")
                )
            }
            Self::Parameter {
                generator,
                name,
                rule,
            } => write!(f, "generator `{generator}`: `{name}` {rule}"),
        }
    }
}

impl std::error::Error for GenerateError {}

/// What a generator's function gets: checked, and completed from the defaults.
struct Parameters {
    size: [u32; 2],
    seed: u32,
    cells: [u32; 2],
    colors: Vec<Color>,
    relief: f32,
}

impl Parameters {
    fn color(&self, index: usize) -> Color {
        self.colors.get(index).copied().unwrap_or([0.0; 4])
    }
}

/// One kind of picture.
pub struct Generator {
    /// The name in a scene file.
    pub name: &'static str,
    /// What the picture shows, which parameters it takes, and whether it is seamless; one line.
    pub doc: &'static str,
    cells: Option<[u32; 2]>,
    colors: &'static [Color],
    relief: Option<f32>,
    draw: fn(&Parameters) -> RgbaImage,
}

/// How high the stained glass is, in parts of its shorter side.
const GLASS_RELIEF: f32 = 0.012;

/// Every generator.
pub static GENERATORS: &[Generator] = &[
    Generator {
        name: "solid",
        doc: "One colour. Seamless.",
        cells: None,
        colors: &[rgb(1.0, 1.0, 1.0)],
        relief: None,
        draw: |p| paint(p.size, |_, _| p.color(0)),
    },
    Generator {
        name: "checker",
        doc: "Squares of two colours; cells are squares across and down. Seamless with even numbers.",
        cells: Some([8, 8]),
        colors: &[rgb(0.9, 0.9, 0.9), rgb(0.15, 0.15, 0.15)],
        relief: None,
        draw: |p| {
            paint(p.size, |u, v| {
                let square = (u * p.cells[0] as f32) as usize + (v * p.cells[1] as f32) as usize;
                p.color(square % 2)
            })
        },
    },
    Generator {
        name: "gradient",
        doc: "From the first colour at the top to the second at the bottom.",
        cells: None,
        colors: &[rgb(1.0, 1.0, 1.0), rgb(0.0, 0.0, 0.0)],
        relief: None,
        draw: |p| paint(p.size, |_, v| blend(p.color(0), p.color(1), v)),
    },
    Generator {
        name: "bricks",
        doc: "A brick wall; cells are bricks in a row and rows (made even); bricks vary between two colours. Seamless.",
        cells: Some([4, 10]),
        colors: &[rgb(0.58, 0.23, 0.15), rgb(0.42, 0.17, 0.12)],
        relief: None,
        draw: wall::bricks,
    },
    Generator {
        name: "stone",
        doc: "A wall of hewn stone; cells are blocks in a row and rows (made even); blocks vary between two colours. Seamless.",
        cells: Some([3, 6]),
        colors: &[rgb(0.56, 0.53, 0.47), rgb(0.43, 0.42, 0.40)],
        relief: None,
        draw: wall::stone,
    },
    Generator {
        name: "planks",
        doc: "A plank floor, boards along u; cells are pieces of a board and boards; light and dark colour of the wood. Seamless.",
        cells: Some([2, 6]),
        colors: &[rgb(0.62, 0.42, 0.24), rgb(0.34, 0.20, 0.10)],
        relief: None,
        draw: wall::planks,
    },
    Generator {
        name: "plaster",
        doc: "Uneven plaster of one colour; cells are clouds across and down. Seamless.",
        cells: Some([4, 4]),
        colors: &[rgb(0.84, 0.78, 0.66)],
        relief: None,
        draw: wall::plaster,
    },
    Generator {
        name: "chest",
        doc: "The texture of the chest mesh; colours: light wood, dark wood, iron, brass; the second number of cells is planks.",
        cells: Some([1, 4]),
        colors: &[
            rgb(0.60, 0.34, 0.15),
            rgb(0.30, 0.14, 0.06),
            rgb(0.22, 0.22, 0.24),
            rgb(0.85, 0.64, 0.22),
        ],
        relief: None,
        draw: chest::atlas,
    },
    Generator {
        name: "stained_glass_base",
        doc: "A leaded window with a rosette: colours of glass and lead, alpha 1. Same size and seed as the other two maps.",
        cells: None,
        colors: &[],
        relief: None,
        draw: |p| {
            let window = glass::Window::new(p.size, p.seed);
            paint(p.size, |u, v| window.base(u, v))
        },
    },
    Generator {
        name: "stained_glass_gloss",
        doc: "The gloss map of the same window, grey: bright on glass, dark on lead.",
        cells: None,
        colors: &[],
        relief: None,
        draw: |p| {
            let window = glass::Window::new(p.size, p.seed);
            paint(p.size, |u, v| window.gloss(u, v))
        },
    },
    Generator {
        name: "stained_glass_normal",
        doc: "The normal map of the same window, n * 0.5 + 0.5, x along u, y along v, z out; relief is its height.",
        cells: None,
        colors: &[],
        relief: Some(GLASS_RELIEF),
        draw: |p| {
            let shorter = p.size[0].min(p.size[1]) as f32;
            stained_glass_height(p.size, p.seed).normal_map(p.relief * shorter, false)
        },
    },
    Generator {
        name: "flat_normal",
        doc: "The normal map of a flat surface: (128, 128, 255). Seamless.",
        cells: None,
        colors: &[],
        relief: None,
        draw: |p| height::flat_normal(p.size),
    },
];

/// The relief of the stained glass window, heights 0 to 1. `size` is clamped to [`MAX_SIZE`].
pub fn stained_glass_height(size: [u32; 2], seed: u32) -> HeightField {
    let size = size.map(|s| s.clamp(1, MAX_SIZE));
    let window = glass::Window::new(size, seed);
    let heights = plot(size, |u, v| window.height(u, v));
    HeightField::new(size, heights)
        .unwrap_or_else(|| HeightField::from(&image::GrayImage::new(1, 1)))
}

impl Generator {
    /// The generator of that name.
    ///
    /// # Errors
    /// [`GenerateError::Unknown`], whose text lists the names there are.
    pub fn find(name: &str) -> Result<&'static Self, GenerateError> {
        GENERATORS
            .iter()
            .find(|g| g.name == name)
            .ok_or_else(|| GenerateError::Unknown(name.to_owned()))
    }

    fn parameters(&self, request: &Request) -> Result<Parameters, GenerateError> {
        let error = |name, rule: String| {
            Err(GenerateError::Parameter {
                generator: self.name,
                name,
                rule,
            })
        };
        let size = request.size.unwrap_or([512; 2]);
        if size.iter().any(|s| !(1..=MAX_SIZE).contains(s)) {
            return error(
                "size",
                format!(
                    "is {} by {}; each must be 1 to {MAX_SIZE}",
                    size[0], size[1]
                ),
            );
        }
        let cells = match (request.cells, self.cells) {
            (Some(_), None) => {
                return error("cells", "is not a parameter of this generator".to_owned());
            }
            (Some(cells), _) if cells.iter().any(|c| !(1..=MAX_CELLS).contains(c)) => {
                return error(
                    "cells",
                    format!(
                        "are {} by {}; each must be 1 to {MAX_CELLS}",
                        cells[0], cells[1]
                    ),
                );
            }
            (given, default) => given.or(default).unwrap_or([1; 2]),
        };
        if request.colors.len() > self.colors.len() {
            return error(
                "colors",
                format!(
                    "has {} colours; this generator takes {}",
                    request.colors.len(),
                    self.colors.len()
                ),
            );
        }
        if request
            .colors
            .iter()
            .flatten()
            .any(|c| !(0.0..=1.0).contains(c))
        {
            return error("colors", "has a component outside 0 to 1".to_owned());
        }
        let relief = match (request.relief, self.relief) {
            (Some(_), None) => {
                return error("relief", "is not a parameter of this generator".to_owned());
            }
            (Some(relief), _) if !(0.0..=1.0).contains(&relief) => {
                return error("relief", format!("is {relief}; it must be 0 to 1"));
            }
            (given, default) => given.or(default).unwrap_or(0.0),
        };
        let colors = request
            .colors
            .iter()
            .chain(self.colors.iter().skip(request.colors.len()))
            .copied()
            .collect();
        Ok(Parameters {
            size,
            seed: request.seed.unwrap_or(1),
            cells,
            colors,
            relief,
        })
    }
}

impl Request {
    /// A request for a generator with all its defaults.
    pub fn new(generate: &str) -> Self {
        Self {
            generate: generate.to_owned(),
            size: None,
            seed: None,
            cells: None,
            colors: Vec::new(),
            relief: None,
        }
    }

    /// Makes the picture, 8 bits a channel, alpha not multiplied in.
    ///
    /// # Errors
    /// An unknown name, or a parameter that is out of range or that the generator does not have.
    pub fn draw(&self) -> Result<RgbaImage, GenerateError> {
        let generator = Generator::find(&self.generate)?;
        Ok((generator.draw)(&generator.parameters(self)?))
    }
}
