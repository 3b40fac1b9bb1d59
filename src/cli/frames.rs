//! Moving pictures: a camera that turns, and frames in one animated PNG.

use super::Failure;
use image::RgbaImage;
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter};

/// Frames a second.
const RATE: u16 = 20;

/// How the camera moves.
#[derive(clap::Args)]
pub(super) struct Motion {
    /// Write an animated PNG of so many frames, 1 to 600, at 20 a second, in which the camera turns around what it looks at.
    /// Cameras of render targets stay.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=600), conflicts_with_all = ["show", "draw"])]
    pub(super) frames: Option<u32>,
    /// How far the camera turns in all, in degrees, clockwise as seen from above.
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = 360.0,
        value_parser = degrees,
        allow_hyphen_values = true,
        requires = "frames"
    )]
    turn: f32,
    /// Instead of turning, swing so far from one side to the other and back.
    #[arg(long, value_name = "DEGREES", value_parser = degrees, allow_hyphen_values = true, requires = "frames", conflicts_with = "turn")]
    swing: Option<f32>,
}

/// The value parser of angles.
fn degrees(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number: &f32| number.is_finite());
    number.ok_or_else(|| format!("`{text}` is no angle"))
}

impl Motion {
    /// By how many degrees the camera is turned in a frame. After the last one the first follows.
    pub(super) fn angle(&self, number: u32, count: u32) -> f32 {
        let part = number as f32 / count as f32;
        match self.swing {
            None => self.turn * part,
            Some(swing) => swing / 2.0 * (std::f32::consts::TAU * part).sin(),
        }
    }
}

/// An animated PNG of so many frames of this size, which it asks for one after the other. It plays for ever; what shows no
/// animations shows the first frame.
///
/// # Errors
/// Those of the frames, and frames of another size.
pub(super) fn animated(
    [width, height]: [u32; 2],
    count: u32,
    mut frame: impl FnMut(u32) -> Result<RgbaImage, Failure>,
) -> Result<Vec<u8>, Failure> {
    let failed = |error: EncodingError| {
        Failure::Input(format!("the frames cannot be written as PNG: {error}"))
    };
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    encoder.set_filter(Filter::Adaptive);
    encoder.set_animated(count, 0).map_err(failed)?;
    encoder.set_frame_delay(1, RATE).map_err(failed)?;
    let mut writer = encoder.write_header().map_err(failed)?;
    for number in 0..count {
        writer
            .write_image_data(frame(number)?.as_raw())
            .map_err(failed)?;
    }
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(turn: f32, swing: Option<f32>) -> Motion {
        Motion {
            frames: Some(8),
            turn,
            swing,
        }
    }

    #[test]
    fn angles() {
        let angles = |motion: Motion| [0, 2, 4, 6].map(|number| motion.angle(number, 8).round());
        assert_eq!(angles(motion(360.0, None)), [0.0, 90.0, 180.0, 270.0]);
        // A quarter of the way it is farthest to one side, at three quarters to the other.
        assert_eq!(angles(motion(360.0, Some(30.0))), [0.0, 15.0, 0.0, -15.0]);
    }

    #[test]
    fn frames_follow_each_other_in_one_file() {
        let file = animated([3, 2], 4, |number| {
            Ok(RgbaImage::from_pixel(
                3,
                2,
                image::Rgba([number as u8, 0, 0, 255]),
            ))
        });
        let Ok(file) = file else {
            panic!("four frames of one size")
        };
        let decoder = png::Decoder::new(std::io::Cursor::new(file));
        let mut reader = decoder.read_info().expect("it is a PNG");
        let animation = reader.info().animation_control.expect("it is animated");
        assert_eq!((animation.num_frames, animation.num_plays), (4, 0));
        for number in 0..4 {
            let mut frame = vec![0; 3 * 2 * 4];
            reader.next_frame(&mut frame).expect("another frame");
            assert_eq!(frame[..4], [number, 0, 0, 255]);
        }
    }
}
