//! The vertices of a draw call.
//!
//! They lie in blocks, each output of a block in rows of its own: vertex shaders leave them so, set-up goes over them in
//! loops without gaps, and outputs that a shader does not write take no memory.

use glam::Vec4;

use super::pixel::LANES;
use super::{SETS, Vertex};

/// A number of each vertex of a block.
pub(super) type Row = [f32; LANES];

/// What a vertex shader may leave of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Output {
    Position,
    Diffuse,
    Specular,
    Fog,
    PointSize,
    Texcoords(usize),
}

impl Output {
    /// How many there are.
    const COUNT: usize = 5 + SETS;

    /// All of them, each at its number.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        use Output::{Diffuse, Fog, PointSize, Position, Specular, Texcoords};
        { [Position, Diffuse, Specular, Fog, PointSize].into_iter() }
            .chain((0..SETS).map(Texcoords))
    }

    #[inline(always)]
    fn number(self) -> usize {
        match self {
            Self::Position => 0,
            Self::Diffuse => 1,
            Self::Specular => 2,
            Self::Fog => 3,
            Self::PointSize => 4,
            Self::Texcoords(set) => 5 + set % SETS,
        }
    }

    /// How many numbers it has.
    fn components(self) -> usize {
        match self {
            Self::Fog | Self::PointSize => 1,
            _ => 4,
        }
    }

    /// What a vertex has without it.
    #[inline(always)]
    pub(super) fn default(self) -> f32 {
        match self {
            Self::Diffuse => 1.0,
            _ => 0.0,
        }
    }
}

/// Where in a block the rows of each output begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    /// The rows of a block.
    stride: usize,
    /// By the number of the output. 0 is none, but for the position, which is always there.
    places: [usize; Output::COUNT],
}

impl Layout {
    #[inline(always)]
    fn place(&self, output: Output) -> Option<usize> {
        let place = self.places[output.number()];
        (place != 0 || output == Output::Position).then_some(place)
    }

    /// The rows of an output in a block, in order of the components; none of one that is not there.
    pub(super) fn rows<'b>(&self, block: &'b mut [Row], output: Output) -> &'b mut [Row] {
        let place = self.place(output);
        let rows = place.and_then(|place| block.get_mut(place..place + output.components()));
        rows.unwrap_or_default()
    }
}

/// The vertices of a draw call as a vertex shader left them: what [`shade_vertices`](super::shade_vertices) makes, or made
/// from a row of [`Vertex`].
#[derive(Clone, Debug)]
pub struct Vertices {
    count: usize,
    layout: Layout,
    rows: Vec<Row>,
}

impl Vertices {
    /// So many vertices, all numbers 0, with a position and the outputs that are asked for.
    pub(super) fn new(count: usize, has: impl Fn(Output) -> bool) -> Self {
        let mut layout = Layout {
            stride: 0,
            places: [0; Output::COUNT],
        };
        for output in Output::all() {
            if output == Output::Position || has(output) {
                layout.places[output.number()] = layout.stride;
                layout.stride += output.components();
            }
        }
        Self {
            count,
            layout,
            rows: vec![[0.0; LANES]; count.div_ceil(LANES) * layout.stride],
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// A vertex by its number; none beyond the last.
    pub fn get(&self, vertex: usize) -> Option<Vertex> {
        let number = u32::try_from(vertex).ok().filter(|_| vertex < self.count)?;
        let four = |output| {
            let component = |component| self.number(output, component, number);
            Vec4::from_array(std::array::from_fn(component))
        };
        let sized = self.layout.place(Output::PointSize).is_some();
        Some(Vertex {
            position: four(Output::Position),
            diffuse: four(Output::Diffuse),
            specular: four(Output::Specular),
            texcoords: std::array::from_fn(|set| four(Output::Texcoords(set))),
            fog: self.number(Output::Fog, 0, number),
            point_size: sized.then(|| self.number(Output::PointSize, 0, number)),
        })
    }

    /// The position of a vertex.
    pub(super) fn position(&self, vertex: u32) -> Vec4 {
        let component = |component| self.number(Output::Position, component, vertex);
        Vec4::from_array(std::array::from_fn(component))
    }

    /// The point size of a vertex, if the shader wrote it.
    pub(super) fn point_size(&self, vertex: u32) -> Option<f32> {
        self.layout.place(Output::PointSize)?;
        Some(self.number(Output::PointSize, 0, vertex))
    }

    /// A component of an output of a vertex.
    fn number(&self, output: Output, component: usize, vertex: u32) -> f32 {
        self.column(output, component).at(vertex)
    }

    /// A component of an output of all vertices.
    pub(super) fn column(&self, output: Output, component: usize) -> Column<'_> {
        let rows = (self.layout.place(output)).and_then(|place| self.rows.get(place + component..));
        Column {
            rows: rows.unwrap_or_default(),
            stride: self.layout.stride,
            default: output.default(),
        }
    }

    pub(super) fn layout(&self) -> Layout {
        self.layout
    }

    /// All rows, and how many a block has.
    pub(super) fn blocks_mut(&mut self) -> (&mut [Row], usize) {
        (&mut self.rows, self.layout.stride)
    }

    /// The x, y, z and w of the positions of a block.
    pub(super) fn positions(&self, block: usize) -> &[Row; 4] {
        const NOTHING: [Row; 4] = [[0.0; LANES]; 4];
        let rows = self.rows.get(block * self.layout.stride..);
        rows.and_then(<[Row]>::first_chunk).unwrap_or(&NOTHING)
    }
}

/// One number of each vertex.
#[derive(Clone, Copy)]
pub(super) struct Column<'a> {
    /// The first is that of the first block.
    rows: &'a [Row],
    stride: usize,
    default: f32,
}

impl Column<'_> {
    #[inline(always)]
    fn at(&self, vertex: u32) -> f32 {
        let (block, lane) = (vertex as usize / LANES, vertex as usize % LANES);
        let row = self.rows.get(block * self.stride);
        row.map_or(self.default, |row| row[lane])
    }

    /// The numbers of three vertices. Not a loop: what is called in one is easily left out of line.
    #[inline(always)]
    pub(super) fn at_three(&self, a: u32, b: u32, c: u32) -> [f32; 3] {
        [self.at(a), self.at(b), self.at(c)]
    }
}

/// Vertices of one shader: either all of them have a point size or none. The first decides; where one is missing then, it is 0.
impl From<&[Vertex]> for Vertices {
    fn from(vertices: &[Vertex]) -> Self {
        let sized = vertices.first().is_some_and(|v| v.point_size.is_some());
        let has = |output| output != Output::PointSize || sized;
        let mut all = Self::new(vertices.len(), has);
        let layout = all.layout;
        let blocks = all.rows.chunks_mut(layout.stride);
        for (rows, vertices) in blocks.zip(vertices.chunks(LANES)) {
            for output in Output::all() {
                let rows = layout.rows(rows, output);
                for (lane, vertex) in vertices.iter().enumerate() {
                    let numbers = match output {
                        Output::Position => vertex.position,
                        Output::Diffuse => vertex.diffuse,
                        Output::Specular => vertex.specular,
                        Output::Fog => Vec4::splat(vertex.fog),
                        Output::PointSize => Vec4::splat(vertex.point_size.unwrap_or(0.0)),
                        Output::Texcoords(set) => vertex.texcoords[set],
                    };
                    for (row, number) in rows.iter_mut().zip(numbers.to_array()) {
                        row[lane] = number;
                    }
                }
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_come_back_as_they_were() {
        let vertex = |i: usize| Vertex {
            position: Vec4::splat(i as f32),
            specular: Vec4::splat(-(i as f32)),
            texcoords: std::array::from_fn(|set| Vec4::splat((100 * set + i) as f32)),
            fog: 0.5,
            point_size: Some(i as f32 + 0.25),
            ..Vertex::default()
        };
        // Two blocks, the second not full.
        let given: Vec<Vertex> = (0..LANES + 3).map(vertex).collect();
        let vertices = Vertices::from(&given[..]);
        assert_eq!(vertices.len(), LANES + 3);
        assert!((0..given.len()).all(|i| vertices.get(i) == Some(given[i])));
        assert_eq!(vertices.get(LANES + 3), None);
        assert!(Vertices::from(&[][..]).is_empty());
    }

    #[test]
    fn outputs_that_are_not_there_read_as_those_of_a_vertex_by_itself() {
        let vertices = Vertices::new(1, |output| output == Output::Texcoords(3));
        let expected = Vertex {
            position: Vec4::ZERO,
            ..Vertex::default()
        };
        assert_eq!(vertices.get(0), Some(expected));
        // A position and one coordinate set.
        assert_eq!(vertices.rows.len(), 8);
    }
}
