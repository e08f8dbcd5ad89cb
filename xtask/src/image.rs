//! Finished pictures: eight bits a channel, as PNG and as animated PNG.

use std::io;

/// A picture of sRGB pixels, row by row from the top, opaque where alpha is 255.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    /// Four bytes a pixel: red, green, blue, alpha (not premultiplied).
    rgba: Vec<u8>,
}

impl Image {
    /// A picture from its pixels; missing ones are transparent, extra ones are dropped.
    #[must_use]
    pub fn new(width: u32, height: u32, mut rgba: Vec<u8>) -> Self {
        rgba.resize(width as usize * height as usize * 4, 0);
        Self {
            width,
            height,
            rgba,
        }
    }

    /// Width in pixels.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The bytes, four a pixel, row by row from the top.
    #[must_use]
    pub fn rgba(&self) -> &[u8] {
        &self.rgba
    }

    /// The pixel in column `x` and row `y`, if it is inside.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let start = (y as usize * self.width as usize + x as usize) * 4;
        self.rgba.get(start..start + 4)?.try_into().ok()
    }

    /// Pictures side by side, aligned at the top, on white.
    #[must_use]
    pub fn beside(images: &[Self]) -> Self {
        let width = images.iter().map(|image| image.width).sum();
        let height = images.iter().map(|image| image.height).max().unwrap_or(0);
        let mut rgba = Vec::with_capacity(width as usize * height as usize * 4);
        for y in 0..height {
            for image in images {
                let row = image.width as usize * 4;
                match image.rgba.get(y as usize * row..(y as usize + 1) * row) {
                    Some(pixels) => rgba.extend_from_slice(pixels),
                    None => rgba.resize(rgba.len() + row, 255),
                }
            }
        }
        Self {
            width,
            height,
            rgba,
        }
    }

    /// The largest and the root-mean-square difference of two pictures' bytes; `None` if their sizes differ.
    #[must_use]
    pub fn difference(&self, other: &Self) -> Option<(u8, f64)> {
        if (self.width, self.height) != (other.width, other.height) {
            return None;
        }
        let differences = self
            .rgba
            .iter()
            .zip(&other.rgba)
            .map(|(a, b)| a.abs_diff(*b));
        let largest = differences.clone().max().unwrap_or(0);
        let squares: f64 = differences.map(|d| f64::from(d).powi(2)).sum();
        Some((largest, (squares / self.rgba.len().max(1) as f64).sqrt()))
    }

    /// The picture as PNG.
    ///
    /// # Errors
    /// Whatever the writer reports; a picture without pixels cannot be a PNG.
    pub fn write_png(&self, writer: impl io::Write) -> io::Result<()> {
        let mut encoder = encoder(writer, self);
        encoder.set_compression(png::Compression::Balanced);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.rgba)?;
        writer.finish()?;
        Ok(())
    }
}

fn encoder<'a, W: io::Write>(writer: W, image: &Image) -> png::Encoder<'a, W> {
    let mut encoder = png::Encoder::new(writer, image.width, image.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder
}

/// Frames of equal size, shown in turn for ever, as one animated PNG.
///
/// A viewer that knows only PNG shows the first frame. Every later frame stores only the
/// rectangle in which it differs from the one before.
///
/// # Errors
/// Whatever the writer reports, and if there is no frame or the sizes differ.
pub fn write_animation(
    frames: &[Image],
    frames_per_second: u16,
    writer: impl io::Write,
) -> io::Result<()> {
    let invalid = |message: &str| io::Error::new(io::ErrorKind::InvalidInput, message);
    let first = frames
        .first()
        .ok_or_else(|| invalid("an animation needs a frame"))?;
    if frames
        .iter()
        .any(|f| (f.width, f.height) != (first.width, first.height))
    {
        return Err(invalid("the frames of an animation differ in size"));
    }
    let mut encoder = encoder(writer, first);
    encoder.set_animated(frames.len() as u32, 0)?;
    encoder.set_frame_delay(1, frames_per_second.max(1))?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&first.rgba)?;
    for (before, frame) in frames.iter().zip(frames.iter().skip(1)) {
        let (x, y, width, height) = changed(before, frame);
        // The size bound of a frame is checked against the position: move to the corner first.
        writer.reset_frame_position()?;
        writer.set_frame_dimension(width, height)?;
        writer.set_frame_position(x, y)?;
        let row = frame.width as usize * 4;
        let pixels: Vec<u8> = (y..y + height)
            .flat_map(|line| {
                let start = line as usize * row + x as usize * 4;
                frame.rgba[start..start + width as usize * 4]
                    .iter()
                    .copied()
            })
            .collect();
        writer.write_image_data(&pixels)?;
    }
    writer.finish()?;
    Ok(())
}

/// The rectangle (column, row, width, height) outside which two pictures of one size agree.
fn changed(before: &Image, after: &Image) -> (u32, u32, u32, u32) {
    let (mut left, mut top, mut right, mut bottom) = (u32::MAX, u32::MAX, 0, 0);
    let pixels = before.rgba.chunks_exact(4).zip(after.rgba.chunks_exact(4));
    for (index, (a, b)) in pixels.enumerate() {
        if a != b {
            let (x, y) = (index as u32 % after.width, index as u32 / after.width);
            (left, top) = (left.min(x), top.min(y));
            (right, bottom) = (right.max(x), bottom.max(y));
        }
    }
    if left > right {
        (0, 0, 1, 1)
    } else {
        (left, top, right - left + 1, bottom - top + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(position: usize) -> Image {
        let mut rgba = vec![255; 6 * 5 * 4];
        rgba[position * 4] = 0;
        Image::new(6, 5, rgba)
    }

    #[test]
    fn png_reads_back() {
        let mut bytes = Vec::new();
        frame(7).write_png(&mut bytes).unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, frame(7).rgba);
    }

    #[test]
    fn animation_keeps_every_frame() {
        let frames: Vec<Image> = [3, 3, 28].map(frame).into();
        let mut bytes = Vec::new();
        write_animation(&frames, 24, &mut bytes).unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        assert_eq!(reader.info().animation_control().unwrap().num_frames, 3);
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        for _ in 0..3 {
            reader.next_frame(&mut pixels).unwrap();
        }
        let control = reader.info().frame_control().unwrap();
        // From pixel 3 (column 3, row 0) to pixel 28 (column 4, row 4).
        assert_eq!(
            (
                control.x_offset,
                control.y_offset,
                control.width,
                control.height
            ),
            (3, 0, 2, 5)
        );
    }

    #[test]
    fn animation_refuses_no_frames_and_mixed_sizes() {
        assert!(write_animation(&[], 24, Vec::new()).is_err());
        let mixed = [frame(0), Image::new(2, 2, vec![0; 16])];
        assert!(write_animation(&mixed, 24, Vec::new()).is_err());
    }

    #[test]
    fn pictures_stand_beside_each_other() {
        let both = Image::beside(&[frame(0), Image::new(1, 2, vec![9; 8])]);
        assert_eq!((both.width(), both.height()), (7, 5));
        assert_eq!(both.pixel(6, 1), Some([9; 4]));
        assert_eq!(both.pixel(6, 2), Some([255; 4]));
        assert_eq!(both.pixel(7, 0), None);
    }
}
