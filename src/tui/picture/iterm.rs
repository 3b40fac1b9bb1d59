//! The inline images of iTerm2, which WezTerm and mintty know, too.

use super::base64;
use image::RgbImage;

/// What shows a picture at the cursor, one pixel of it on one of the terminal.
pub(super) fn encode(image: &RgbImage) -> String {
    let file = super::png(image);
    format!(
        "\x1b]1337;File=inline=1;size={};width={}px;height={}px;preserveAspectRatio=0;doNotMoveCursor=1:{}\x07",
        file.len(),
        image.width(),
        image.height(),
        base64::encode(&file)
    )
}
