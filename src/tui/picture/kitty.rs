//! The graphics protocol of kitty, which ghostty, WezTerm and Konsole know, too.

use super::base64;
use image::RgbImage;

/// Takes away every picture of this program.
pub(super) const DELETE_ALL: &str = "\x1b_Ga=d,d=A,q=2\x1b\\";

/// Payload bytes in one piece: the protocol's limit.
const PIECE: usize = 4096;

/// What shows a picture at the cursor, which stays where it is. A picture of the same number is replaced.
pub(super) fn encode(image: &RgbImage, number: u32) -> String {
    let payload = base64::encode(&super::png(image));
    let mut out = format!("\x1b_Ga=d,d=I,i={number},q=2\x1b\\");
    let mut pieces = payload.as_bytes().chunks(PIECE).peekable();
    let mut first = true;
    while let Some(piece) = pieces.next() {
        let more = u8::from(pieces.peek().is_some());
        let keys = if first {
            format!("a=T,f=100,i={number},p=1,C=1,q=2,m={more}")
        } else {
            format!("m={more}")
        };
        first = false;
        out += &format!("\x1b_G{keys};{}\x1b\\", String::from_utf8_lossy(piece));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    #[test]
    fn large_pictures_go_in_pieces() {
        // Noise, so that the file is longer than a piece: 64·64·3 bytes that no filter makes small.
        let mut state = 1_u32;
        let image = RgbImage::from_fn(64, 64, |_, _| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            Rgb([(state >> 24) as u8, (state >> 16) as u8, (state >> 8) as u8])
        });
        let text = encode(&image, 7);
        let pieces: Vec<&str> = text.split("\x1b\\").filter(|p| !p.is_empty()).collect();
        assert!(pieces.len() > 3, "{}", pieces.len());
        assert_eq!(pieces[0], "\x1b_Ga=d,d=I,i=7,q=2");
        assert!(pieces[1].starts_with("\x1b_Ga=T,f=100,i=7,p=1,C=1,q=2,m=1;"));
        let last = pieces[pieces.len() - 1];
        assert!(last.starts_with("\x1b_Gm=0;"), "{last}");
        for piece in &pieces[1..] {
            assert!(piece.split_once(';').unwrap().1.len() <= PIECE);
        }
    }
}
