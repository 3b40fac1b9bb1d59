//! Which part of a picture is shown, and how large.

use image::{Rgb, RgbImage};
use ratatui::layout::Rect;

/// A part of a picture, in its pixels; never empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tui) struct Crop {
    /// Column and row of the first pixel.
    pub at: [u32; 2],
    /// Columns and rows.
    pub size: [u32; 2],
}

impl Crop {
    /// The `zoom`-th part of a picture in each direction, with `centre` as near to its middle as the edges let it.
    pub(in crate::tui) fn around(size: [u32; 2], centre: [u32; 2], zoom: u32) -> Self {
        let part: [u32; 2] = std::array::from_fn(|i| (size[i] / zoom.max(1)).max(1));
        let at = std::array::from_fn(|i| {
            let most = size[i].saturating_sub(part[i]);
            centre[i].saturating_sub(part[i] / 2).min(most)
        });
        Self { at, size: part }
    }

    /// The largest size within `room` of the shape of the part.
    fn fit(self, room: [u32; 2]) -> [u32; 2] {
        let [width, height] = self.size.map(u64::from);
        let [room_x, room_y] = room.map(u64::from);
        // Wider than the room: as wide as it; otherwise as high.
        let fitted = if width * room_y > height * room_x {
            [room_x, height * room_x / width]
        } else {
            [width * room_y / height, room_y]
        };
        fitted.map(|n| n.max(1) as u32)
    }
}

/// Where a part of a picture stands on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tui) struct Canvas {
    /// The cells that it covers.
    pub area: Rect,
    /// Its size in pixels of the terminal, or in halves of cells.
    pub target: [u32; 2],
    crop: Crop,
    cell: [u32; 2],
}

impl Canvas {
    /// A part of a picture in the upper left of `room`, as large as it can be. `cell` is the size of a cell in pixels; without
    /// one the picture is drawn in half blocks. `None` if there is no room.
    pub(in crate::tui) fn new(room: Rect, crop: Crop, cell: Option<[u16; 2]>) -> Option<Self> {
        if room.is_empty() {
            return None;
        }
        let cell = cell.unwrap_or([1, 2]).map(u32::from);
        let target = crop.fit([
            u32::from(room.width) * cell[0],
            u32::from(room.height) * cell[1],
        ]);
        let cells: [u32; 2] = std::array::from_fn(|i| target[i].div_ceil(cell[i]));
        let area = Rect::new(room.x, room.y, cells[0] as u16, cells[1] as u16).intersection(room);
        Some(Self {
            area,
            target,
            crop,
            cell,
        })
    }

    /// The pixels of the target that a pixel of the picture covers, first and last in each direction; `None` outside of the part.
    pub(in crate::tui) fn target_of(&self, pixel: [u32; 2]) -> Option<[[u32; 2]; 2]> {
        let mut covered = [[0; 2]; 2];
        for i in 0..2 {
            let offset = pixel[i].checked_sub(self.crop.at[i])?;
            if offset >= self.crop.size[i] {
                return None;
            }
            let (size, target) = (u64::from(self.crop.size[i]), u64::from(self.target[i]));
            let edge = |offset: u32| u64::from(offset) * target / size;
            let (first, end) = (edge(offset), edge(offset + 1));
            let first = first.min(target - 1);
            covered[i] = [first as u32, end.saturating_sub(1).max(first) as u32];
        }
        Some(covered)
    }

    /// The cell in which the middle of a pixel of the picture stands.
    pub(in crate::tui) fn cell_of(&self, pixel: [u32; 2]) -> Option<[u16; 2]> {
        let [x, y] = self.target_of(pixel)?;
        let middle =
            |[first, last]: [u32; 2], i: usize| (first + (last - first) / 2) / self.cell[i];
        let cell = [middle(x, 0) as u16, middle(y, 1) as u16];
        Some([self.area.x + cell[0], self.area.y + cell[1]])
    }

    /// The pixel of the picture in the middle of a cell.
    pub(in crate::tui) fn pixel_at(&self, x: u16, y: u16) -> Option<[u32; 2]> {
        if !self.area.contains((x, y).into()) {
            return None;
        }
        let cell = [u32::from(x - self.area.x), u32::from(y - self.area.y)];
        Some(std::array::from_fn(|i| {
            let point = u64::from(cell[i] * self.cell[i] + self.cell[i] / 2);
            let (size, target) = (u64::from(self.crop.size[i]), u64::from(self.target[i]));
            // The middle of the point, so that what `target_of` gives leads back.
            let offset = (2 * point + 1) * size / (2 * target);
            self.crop.at[i] + (offset as u32).min(self.crop.size[i] - 1)
        }))
    }

    /// The pixels of the target: each the mean of some that it covers, or the one it is a part of.
    pub(in crate::tui) fn draw(&self, at: impl Fn(u32, u32) -> [u8; 3]) -> RgbImage {
        resample(self.crop, self.target, at)
    }
}

/// How many pixels are looked at in each direction for one of the target.
const MOST_SAMPLES: u32 = 4;

/// A part of a picture in another size.
fn resample(crop: Crop, target: [u32; 2], at: impl Fn(u32, u32) -> [u8; 3]) -> RgbImage {
    // Middles of equal shares of what a pixel of the target covers.
    let places = |i: usize, point: u32| {
        let count = crop.size[i].div_ceil(target[i]).clamp(1, MOST_SAMPLES);
        let count = u64::from(count);
        let (size, target) = (u64::from(crop.size[i]), u64::from(target[i]));
        (0..count).map(move |share| {
            let place =
                (u64::from(point) * 2 * count + 2 * share + 1) * size / (2 * count * target);
            crop.at[i] + (place as u32).min(crop.size[i] - 1)
        })
    };
    RgbImage::from_fn(target[0], target[1], |x, y| {
        let (mut sum, mut count) = ([0_u32; 3], 0);
        for row in places(1, y) {
            for column in places(0, x) {
                let color = at(column, row);
                sum = std::array::from_fn(|c| sum[c] + u32::from(color[c]));
                count += 1;
            }
        }
        Rgb(sum.map(|c| ((c + count / 2) / count.max(1)) as u8))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_stays_within_the_picture() {
        let crop = |centre| Crop::around([100, 80], centre, 4);
        // A quarter of each side: 25×20; half of that to the left of the centre.
        assert_eq!(crop([50, 40]).at, [38, 30]);
        assert_eq!(crop([0, 79]).at, [0, 60]);
        assert_eq!(crop([50, 40]).size, [25, 20]);
        assert_eq!(Crop::around([3, 3], [1, 1], 64).size, [1, 1]);
    }

    #[test]
    fn a_picture_keeps_its_shape() {
        // 4:3 in 20×10 cells of half blocks, 20×20 halves: as wide as the room, 15 halves high, 8 cells.
        let crop = Crop::around([640, 480], [0, 0], 1);
        let canvas = Canvas::new(Rect::new(2, 3, 20, 10), crop, None).unwrap();
        assert_eq!(canvas.target, [20, 15]);
        assert_eq!(canvas.area, Rect::new(2, 3, 20, 8));
        // In cells of 10×20 pixels there are 200×200.
        let canvas = Canvas::new(Rect::new(2, 3, 20, 10), crop, Some([10, 20])).unwrap();
        assert_eq!(canvas.target, [200, 150]);
        assert_eq!(Canvas::new(Rect::new(2, 3, 0, 10), crop, None), None);
    }

    #[test]
    fn cells_and_pixels_lead_to_each_other() {
        // 4×4 pixels in 8×8 halves, 8×4 cells: each pixel is two cells wide and one high.
        let crop = Crop::around([4, 4], [0, 0], 1);
        let canvas = Canvas::new(Rect::new(10, 5, 8, 4), crop, None).unwrap();
        assert_eq!(canvas.target_of([1, 2]), Some([[2, 3], [4, 5]]));
        assert_eq!(canvas.cell_of([1, 2]), Some([12, 7]));
        assert_eq!(canvas.pixel_at(12, 7), Some([1, 2]));
        assert_eq!(canvas.pixel_at(13, 7), Some([1, 2]));
        assert_eq!(canvas.pixel_at(9, 7), None);
        assert_eq!(canvas.target_of([4, 0]), None);
        // Shrunk: every cell leads to a pixel that leads back to it.
        let crop = Crop::around([641, 479], [0, 0], 1);
        for cell in [None, Some([9, 19])] {
            let canvas = Canvas::new(Rect::new(1, 1, 23, 9), crop, cell).unwrap();
            for (x, y) in canvas.area.positions().map(|p| (p.x, p.y)) {
                let pixel = canvas.pixel_at(x, y).unwrap();
                let full = (u32::from(y - 1) + 1) * canvas.cell[1] <= canvas.target[1]
                    && (u32::from(x - 1) + 1) * canvas.cell[0] <= canvas.target[0];
                if full {
                    assert_eq!(canvas.cell_of(pixel), Some([x, y]));
                }
            }
        }
    }

    #[test]
    fn shrinking_takes_the_mean() {
        // Columns of 0 and 200, two of them in each pixel: 100. Enlarged they stay as they are.
        let columns = |x: u32, _: u32| [if x.is_multiple_of(2) { 0 } else { 200 }; 3];
        let crop = Crop::around([8, 8], [0, 0], 1);
        let small = resample(crop, [4, 4], columns);
        assert!(small.pixels().all(|p| p.0 == [100; 3]));
        let large = resample(crop, [16, 16], columns);
        assert_eq!(large.get_pixel(1, 0).0, [0; 3]);
        assert_eq!(large.get_pixel(2, 0).0, [200; 3]);
    }
}
