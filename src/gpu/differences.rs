//! How far two pictures are apart.

use image::RgbaImage;

use crate::raster::Target;
use crate::scene::LevelRange;

/// How far the level of detail of an adapter may be from the true one, in levels, where nothing says better: that of Mesa's
/// software adapter, which has a linear mantissa where a logarithm should be, is off by as much. No document of WebGPU or
/// Vulkan bounds it.
pub const LEVEL_ERROR: f32 = 0.0625;

/// The differences between two pictures of one size, in steps of 1/255.
#[derive(Clone, Debug, PartialEq)]
pub struct Differences {
    /// The greatest difference of red, green, blue and alpha.
    pub max_of_channel: [u8; 4],
    /// The sum of all differences of each channel.
    sums: [u64; 4],
    /// How many pixels have each greatest difference of a channel, 0 to 255.
    histogram: [u64; 256],
    /// The first pixel with the greatest difference; none if the pictures are equal.
    pub worst: Option<WorstPixel>,
}

/// The pixel where two pictures differ most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorstPixel {
    /// Its column.
    pub x: u32,
    /// Its row.
    pub y: u32,
    /// Its colour in the first picture.
    pub cpu: [u8; 4],
    /// Its colour in the second.
    pub gpu: [u8; 4],
}

impl Differences {
    /// Compares two pictures; none if they are not of one size.
    pub fn between(cpu: &RgbaImage, gpu: &RgbaImage) -> Option<Self> {
        Self::among(cpu, gpu, |_, _| true)
    }

    /// Compares what the CPU has drawn with the picture of a GPU, the pixels inside of triangles ([`Target::inside`]) and
    /// those on edges apart; none if they are not of one size.
    pub fn inside_and_on_edges(cpu: &Target, gpu: &RgbaImage) -> Option<[Self; 2]> {
        Self::beside(cpu, &cpu.to_image(), gpu)
    }

    /// The same, but only what is left of a difference when the levels of detail may be off as the range says.
    pub fn beyond_levels(cpu: &Target, range: &LevelRange, gpu: &RgbaImage) -> Option<[Self; 2]> {
        Self::beside(cpu, &range.nearest(gpu), gpu)
    }

    /// Compares two pictures, the pixels inside of what `cpu` holds and those on edges apart.
    fn beside(cpu: &Target, picture: &RgbaImage, gpu: &RgbaImage) -> Option<[Self; 2]> {
        let inside = Self::among(picture, gpu, |x, y| cpu.inside(x, y))?;
        let edges = Self::among(picture, gpu, |x, y| !cpu.inside(x, y))?;
        Some([inside, edges])
    }

    /// Compares the pixels that count; none if the pictures are not of one size.
    fn among(cpu: &RgbaImage, gpu: &RgbaImage, counts: impl Fn(u32, u32) -> bool) -> Option<Self> {
        if cpu.dimensions() != gpu.dimensions() {
            return None;
        }
        let mut differences = Self {
            max_of_channel: [0; 4],
            sums: [0; 4],
            histogram: [0; 256],
            worst: None,
        };
        let mut most = 0;
        let pixels = cpu.enumerate_pixels().zip(gpu.pixels());
        for ((x, y, a), b) in pixels.filter(|((x, y, _), _)| counts(*x, *y)) {
            let mut of_pixel = 0;
            for (channel, (a, b)) in a.0.into_iter().zip(b.0).enumerate() {
                let difference = a.abs_diff(b);
                of_pixel = difference.max(of_pixel);
                differences.sums[channel] += u64::from(difference);
                let max = &mut differences.max_of_channel[channel];
                *max = difference.max(*max);
            }
            differences.histogram[usize::from(of_pixel)] += 1;
            if of_pixel > most {
                most = of_pixel;
                differences.worst = Some(WorstPixel {
                    x,
                    y,
                    cpu: a.0,
                    gpu: b.0,
                });
            }
        }
        Some(differences)
    }

    /// How many pixels were compared.
    pub fn pixels(&self) -> u64 {
        self.histogram.iter().sum()
    }

    /// The greatest difference of any channel of any pixel.
    pub fn max(&self) -> u8 {
        self.max_of_channel.into_iter().max().unwrap_or(0)
    }

    /// The mean difference of red, green, blue and alpha.
    pub fn mean_of_channel(&self) -> [f64; 4] {
        let pixels = self.pixels().max(1) as f64;
        self.sums.map(|sum| sum as f64 / pixels)
    }

    /// Each difference that occurs, and how many pixels have it as that of their worst channel.
    pub fn counts(&self) -> impl Iterator<Item = (u8, u64)> + '_ {
        let counts = (0..=u8::MAX).zip(self.histogram);
        counts.filter(|(_, count)| *count > 0)
    }

    /// How many pixels have this as the difference of their worst channel.
    pub fn count(&self, difference: u8) -> u64 {
        self.histogram[usize::from(difference)]
    }

    /// How many pixels have a channel that differs by more than this.
    pub fn above(&self, tolerance: u8) -> u64 {
        (self.counts())
            .filter(|(difference, _)| *difference > tolerance)
            .map(|(_, count)| count)
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::ColorFormat;
    use image::Rgba;

    #[test]
    fn channels_pixels_and_the_worst() {
        let a = RgbaImage::from_pixel(2, 2, Rgba([10, 20, 30, 255]));
        let mut b = a.clone();
        b.put_pixel(1, 0, Rgba([12, 20, 29, 255]));
        b.put_pixel(0, 1, Rgba([10, 20, 25, 255]));
        let differences = Differences::between(&a, &b).unwrap();
        assert_eq!(differences.max_of_channel, [2, 0, 5, 0]);
        // Blue: (1 + 5) / 4.
        assert_eq!(differences.mean_of_channel(), [0.5, 0.0, 1.5, 0.0]);
        let counts: Vec<_> = differences.counts().collect();
        assert_eq!(counts, [(0, 2), (2, 1), (5, 1)]);
        assert_eq!((differences.above(1), differences.above(2)), (2, 1));
        let worst = differences.worst.unwrap();
        assert_eq!((worst.x, worst.y, worst.gpu), (0, 1, [10, 20, 25, 255]));
        assert_eq!(Differences::between(&a, &RgbaImage::new(2, 3)), None);
        assert_eq!(Differences::between(&a, &a).unwrap().worst, None);
    }

    /// All depths are 1, so that every pixel is inside; of two columns none is.
    #[test]
    fn inside_and_edges_make_up_the_whole() {
        let differences = |width: u32| {
            let cpu = Target::new(width, 3, ColorFormat::A8R8G8B8).unwrap();
            let gpu = RgbaImage::from_pixel(width, 3, Rgba([0, 0, 7, 0]));
            let [inside, edges] = Differences::inside_and_on_edges(&cpu, &gpu).unwrap();
            [
                (inside.pixels(), inside.max()),
                (edges.pixels(), edges.max()),
            ]
        };
        assert_eq!(differences(3), [(9, 7), (0, 0)]);
        assert_eq!(differences(2), [(0, 0), (6, 7)]);
    }
}
