//! Wavefront OBJ, read through `tobj`.
//!
//! `tobj` parses numbers, joins equal corners into one index and cuts polygons into fans. Before it sees the file, the text
//! goes through [`prepare`], which keeps only `v`, `vt`, `vn` and `f`, says which line is wrong, and gives every corner all
//! three indices: `tobj` alone reports no lines, trusts huge indices, and shifts attributes that only some corners have.

use std::fmt::Write as _;
use std::io::{self, BufRead, Read};

use glam::{Vec2, Vec3, Vec4};

use super::{MAX_TRIANGLES, MAX_VERTICES, Mesh, MeshData, MeshError};

/// Longest OBJ file that is read, in bytes (64 MiB).
pub const MAX_OBJ_BYTES: usize = 64 << 20;

/// How an OBJ file is turned into Direct3D's conventions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "scene",
    derive(serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct ObjOptions {
    /// The file is right-handed with counter-clockwise fronts, as most are: z is negated and the triangles are turned
    /// round. Otherwise positions, normals and corner order are taken as they are. Default yes.
    pub right_handed: bool,
    /// v grows upwards in the file, as OBJ says: v becomes 1 - v. Default yes.
    pub v_up: bool,
}

impl Default for ObjOptions {
    fn default() -> Self {
        Self {
            right_handed: true,
            v_up: true,
        }
    }
}

impl Mesh {
    /// Reads a Wavefront OBJ file from its bytes. All objects and groups become one mesh; materials, lines and points are
    /// left out. Missing normals become smooth, missing texture coordinates zero, and vertex colours are taken if every
    /// vertex has one.
    ///
    /// # Errors
    /// [`MeshError::Obj`] with the line for text that is not OBJ, indices out of range, or a file above the limits
    /// ([`MAX_OBJ_BYTES`], [`MAX_VERTICES`], [`MAX_TRIANGLES`]) or without a face; other [`MeshError`]s for numbers that are not finite.
    pub fn from_obj(bytes: &[u8], options: ObjOptions) -> Result<Self, MeshError> {
        let clean = prepare(bytes)?;
        let mut reader = LineReader {
            lines: &clean.lines,
            text: clean.text.as_bytes(),
            given: 0,
        };
        let load = tobj::LoadOptions {
            single_index: true,
            triangulate: true,
            ignore_points: true,
            ignore_lines: true,
        };
        let no_materials = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
        let (models, _) = tobj::load_obj_buf(&mut reader, &load, no_materials)
            .map_err(|e| error(reader.line(), format!("this cannot be read as OBJ ({e})")))?;
        // One model, since no line that starts another one is left.
        let model = models
            .into_iter()
            .next()
            .ok_or_else(|| error(0, "there is no face in it".to_owned()))?
            .mesh;
        let z = if options.right_handed { -1.0 } else { 1.0 };
        let vectors = |list: &[f32]| {
            list.chunks_exact(3)
                .map(|c| Vec3::new(c[0], c[1], c[2] * z))
                .collect::<Vec<_>>()
        };
        let mut indices = model.indices;
        if options.right_handed {
            for triangle in indices.chunks_exact_mut(3) {
                triangle.swap(1, 2);
            }
        }
        Self::new(MeshData {
            positions: vectors(&model.positions),
            normals: vectors(&model.normals),
            texcoords: (model.texcoords.chunks_exact(2))
                .map(|t| {
                    Vec2::new(
                        t[0],
                        if options.v_up && clean.has_texcoords {
                            1.0 - t[1]
                        } else {
                            t[1]
                        },
                    )
                })
                .collect(),
            colors: model
                .vertex_color
                .chunks_exact(3)
                .map(|c| Vec4::new(c[0], c[1], c[2], 1.0))
                .collect(),
            indices,
            ..MeshData::default()
        })
    }
}

fn error(line: usize, what: String) -> MeshError {
    MeshError::Obj { line, what }
}

/// What `tobj` gets to read.
struct Clean {
    text: String,
    /// For each line of `text`, its line in the file, from 1.
    lines: Vec<u32>,
    /// Whether the file has texture coordinates at all.
    has_texcoords: bool,
}

/// Joins lines that end in a backslash to the next; each with the number of its first line, from 1.
fn statements(text: &str) -> impl Iterator<Item = (usize, String)> + '_ {
    let mut lines = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (number, first) = lines.next()?;
        let mut statement = first.to_owned();
        while statement.ends_with('\\') {
            statement.pop();
            statement.push(' ');
            statement.push_str(lines.next().map_or("", |(_, l)| l));
        }
        Some((number + 1, statement))
    })
}

/// The kinds of index of a face corner, in the order in which they are written.
const KINDS: [&str; 3] = ["v", "vt", "vn"];

fn prepare(bytes: &[u8]) -> Result<Clean, MeshError> {
    if bytes.len() > MAX_OBJ_BYTES {
        return Err(error(
            0,
            format!(
                "it has {} bytes; at most {MAX_OBJ_BYTES} are read",
                bytes.len()
            ),
        ));
    }
    // Comments and names may be in any encoding; what counts is ASCII.
    let file = String::from_utf8_lossy(bytes);
    let (mut totals, mut colored, mut triangles) = ([0_usize; 3], 0_usize, 0_usize);
    for (line, statement) in statements(&file) {
        let mut words = statement.split_whitespace();
        let key = words.next().unwrap_or("");
        if let Some(kind) = KINDS.iter().position(|k| *k == key) {
            totals[kind] += 1;
            // `tobj` would shift all later colours by one that is no number.
            let numbers = words.filter(|w| w.parse::<f32>().is_ok()).count();
            colored += usize::from(kind == 0 && numbers >= 6);
        } else if key == "f" {
            triangles += words.count().saturating_sub(2);
        }
        if triangles > MAX_TRIANGLES || totals[0] > MAX_VERTICES {
            return Err(error(
                line,
                format!("at most {MAX_VERTICES} vertices and {MAX_TRIANGLES} triangles are read"),
            ));
        }
    }
    if triangles == 0 {
        return Err(error(0, "there is no face in it".to_owned()));
    }
    let keep_colors = colored == totals[0];
    let mut clean = Clean {
        text: String::new(),
        lines: Vec::new(),
        has_texcoords: totals[1] > 0,
    };
    // The value for corners that have none stands first: index 1 of its kind. A zero normal asks for the smooth one; v is
    // what the flip of v takes back to zero.
    clean.text.push_str(if clean.has_texcoords {
        "vt 0 1\nvn 0 0 0\n"
    } else {
        "vt 0 0\nvn 0 0 0\n"
    });
    clean.lines.extend([0, 0]);
    let mut seen = [0_usize; 3];
    for (line, statement) in statements(&file) {
        let statement = statement.split('#').next().unwrap_or("");
        let mut words = statement.split_whitespace();
        let key = words.next().unwrap_or("");
        if let Some(kind) = KINDS.iter().position(|k| *k == key) {
            seen[kind] += 1;
            clean.text.push_str(key);
            let most = if kind == 0 && colored > 0 && !keep_colors {
                3
            } else {
                usize::MAX
            };
            for word in words.take(most) {
                let _ = write!(clean.text, " {word}");
            }
        } else if key == "f" {
            let corners: Vec<&str> = words.collect();
            if corners.len() < 3 {
                return Err(error(
                    line,
                    format!(
                        "a face needs at least 3 corners; this has {}",
                        corners.len()
                    ),
                ));
            }
            clean.text.push('f');
            for word in corners {
                let [v, vt, vn] = corner(word, seen, totals).map_err(|what| error(line, what))?;
                let _ = write!(clean.text, " {}/{}/{}", v, vt + 1, vn + 1);
            }
        } else {
            continue;
        }
        clean.text.push('\n');
        clean.lines.push(line as u32);
    }
    Ok(clean)
}

/// The three indices of a corner, from 1; 0 where the corner has none. Negative ones count back from the last value `seen`.
fn corner(word: &str, seen: [usize; 3], totals: [usize; 3]) -> Result<[usize; 3], String> {
    let mut found = [0; 3];
    for (kind, part) in word.split('/').enumerate() {
        let Some(slot) = found.get_mut(kind) else {
            return Err(format!("`{word}` has more than the three indices v/vt/vn"));
        };
        if part.is_empty() && kind > 0 {
            continue;
        }
        let number: i64 = part.parse().map_err(|_| {
            format!("`{word}` is no corner of a face; write v, v/vt, v//vn or v/vt/vn")
        })?;
        let index = if number < 0 {
            seen[kind] as i64 + number.saturating_add(1)
        } else {
            number
        };
        *slot = usize::try_from(index)
            .ok()
            .filter(|i| (1..=totals[kind]).contains(i))
            .ok_or_else(|| {
                format!(
                    "`{word}` names `{}` number {number}, but the file has {}",
                    KINDS[kind], totals[kind]
                )
            })?;
    }
    Ok(found)
}

/// Gives out one line a time, and so knows which one a parser that stopped was at.
struct LineReader<'a> {
    lines: &'a [u32],
    text: &'a [u8],
    given: usize,
}

impl LineReader<'_> {
    fn line(&self) -> usize {
        self.given
            .checked_sub(1)
            .and_then(|i| self.lines.get(i))
            .map_or(0, |l| *l as usize)
    }
}

impl Read for LineReader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}

impl BufRead for LineReader<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        let end = self
            .text
            .iter()
            .position(|b| *b == b'\n')
            .map_or(self.text.len(), |i| i + 1);
        Ok(self.text.get(..end).unwrap_or_default())
    }

    fn consume(&mut self, count: usize) {
        let (taken, rest) = self.text.split_at(count.min(self.text.len()));
        self.given += taken.iter().filter(|b| **b == b'\n').count();
        self.text = rest;
    }
}
