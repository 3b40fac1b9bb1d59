//! Triangles in a tree of boxes, and where a ray first meets one of them.

use glam::DVec3;

/// At most so many triangles are in a leaf.
const LEAF: usize = 4;
/// Rays begin this far from where they begin, so that they do not meet the surface that they leave.
const AWAY: f64 = 1e-5;

/// A ray. The direction need not have length 1; distances are multiples of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    /// The triangle, by its number.
    pub(crate) triangle: usize,
    pub(crate) point: DVec3,
    /// The shares of the second and of the third corner; the first has the rest.
    pub(crate) shares: [f64; 2],
}

/// A box and what is in it.
struct Node {
    low: DVec3,
    high: DVec3,
    /// A leaf: its triangles in the order of the tree. Else: the two children.
    content: Content,
}

enum Content {
    Triangles(std::ops::Range<usize>),
    Children(usize, usize),
}

/// The triangles, sorted into boxes by their centres.
pub(crate) struct Tree {
    corners: Vec<[DVec3; 3]>,
    /// The numbers of the triangles in the order of the leaves.
    order: Vec<usize>,
    nodes: Vec<Node>,
}

impl Tree {
    pub(crate) fn new(corners: Vec<[DVec3; 3]>) -> Self {
        let mut tree = Self {
            order: (0..corners.len()).collect(),
            corners,
            nodes: Vec::new(),
        };
        tree.split(0..tree.corners.len());
        tree
    }

    /// Makes a node of a part of the order, and those below it; gives its number.
    fn split(&mut self, part: std::ops::Range<usize>) -> usize {
        let all = self.order[part.clone()].iter();
        let points = all.flat_map(|triangle| self.corners[*triangle]);
        let (low, high) = points.fold(
            (DVec3::INFINITY, DVec3::NEG_INFINITY),
            |(low, high), point| (low.min(point), high.max(point)),
        );
        let number = self.nodes.len();
        self.nodes.push(Node {
            low,
            high,
            content: Content::Triangles(part.clone()),
        });
        if part.len() > LEAF {
            let longest = (high - low).max_position();
            let center = |triangle: &usize| {
                let [a, b, c] = self.corners[*triangle];
                (a + b + c)[longest]
            };
            let half = part.len() / 2;
            self.order[part.clone()]
                .select_nth_unstable_by(half, |a, b| center(a).total_cmp(&center(b)));
            let middle = part.start + half;
            let first = self.split(part.start..middle);
            let second = self.split(middle..part.end);
            self.nodes[number].content = Content::Children(first, second);
        }
        number
    }

    /// Where a ray first meets a triangle, from either side.
    pub(crate) fn hit(&self, ray: &Ray) -> Option<Hit> {
        let inverse = ray.direction.recip();
        let away = AWAY / ray.direction.length();
        let mut nearest = f64::INFINITY;
        let mut found = None;
        let mut waiting = vec![0];
        while let Some(node) = waiting
            .pop()
            .and_then(|number: usize| self.nodes.get(number))
        {
            let (one, other) = (
                (node.low - ray.origin) * inverse,
                (node.high - ray.origin) * inverse,
            );
            let enters = one.min(other).max_element();
            let leaves = one.max(other).min_element();
            if enters > leaves || leaves < away || enters > nearest {
                continue;
            }
            match &node.content {
                Content::Children(first, second) => waiting.extend([*first, *second]),
                Content::Triangles(part) => {
                    for &triangle in &self.order[part.clone()] {
                        if let Some((distance, shares)) = meet(ray, &self.corners[triangle])
                            && distance > away
                            && distance < nearest
                        {
                            nearest = distance;
                            found = Some((triangle, shares));
                        }
                    }
                }
            }
        }
        found.map(|(triangle, shares)| Hit {
            triangle,
            point: ray.origin + nearest * ray.direction,
            shares,
        })
    }
}

/// Where a ray meets the plane of a triangle, if within it: the distance and the shares of the second and third corner
/// (Möller and Trumbore).
fn meet(ray: &Ray, [a, b, c]: &[DVec3; 3]) -> Option<(f64, [f64; 2])> {
    let (ab, ac) = (b - a, c - a);
    let across = ray.direction.cross(ac);
    let determinant = ab.dot(across);
    if determinant.abs() < 1e-14 {
        return None;
    }
    let to_origin = ray.origin - a;
    let second = to_origin.dot(across) / determinant;
    let other = to_origin.cross(ab);
    let third = ray.direction.dot(other) / determinant;
    let inside = second >= 0.0 && third >= 0.0 && second + third <= 1.0;
    inside.then(|| (ac.dot(other) / determinant, [second, third]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Walls at z = 1, 2, … of two triangles each, many more than a leaf holds.
    fn walls() -> Tree {
        let wall = |z: f64| {
            let at = |x: f64, y: f64| DVec3::new(x, y, z);
            let (a, b, c, d) = (at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0));
            [[a, b, c], [a, c, d]]
        };
        Tree::new((1..=50).flat_map(|z| wall(f64::from(z))).collect())
    }

    #[test]
    fn the_nearest_wall_is_met() {
        let tree = walls();
        let from = |z: f64, direction: DVec3| {
            let origin = DVec3::new(0.25, -0.5, z);
            tree.hit(&Ray { origin, direction })
        };
        // From between two walls forwards and backwards: below the diagonal is the first triangle of each.
        let ahead = from(6.5, DVec3::Z).expect("a wall is ahead");
        assert_eq!((ahead.point.z, ahead.triangle), (7.0, 12));
        let behind = from(6.5, -2.0 * DVec3::Z).expect("a wall is behind");
        assert_eq!((behind.point.z, behind.triangle), (6.0, 10));
        // From a wall the next one, not itself. Beyond the last one there is none, and none beside.
        assert_eq!(from(7.0, DVec3::Z).map(|hit| hit.point.z), Some(8.0));
        assert!(from(50.5, DVec3::Z).is_none());
        assert!(from(0.0, DVec3::X).is_none());
    }
}
