//! OpenEXR files with layers.
//!
//! One part with dotted channel names, which OpenEXR, OpenImageIO and the viewers group into layers.
//! ZIP-compressed scan lines in increasing order: the bytes do not depend on the threads that
//! compress (tiles would be written as they finish).

use std::io::{Seek, Write};

use anyhow::{Result, anyhow};
use exr::prelude::Compression;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer, LayerAttributes,
    LineOrder, SmallVec, Vec2, WritableImage,
};

use super::picture::Pixel;

pub(super) fn write(
    width: u32,
    height: u32,
    pixels: &[Pixel],
    layer: Option<&str>,
    writer: impl Write + Seek,
) -> Result<()> {
    let floats = |name: &str, value: &dyn Fn(&Pixel) -> f32| {
        AnyChannel::new(name, FlatSamples::F32(pixels.iter().map(value).collect()))
    };
    let ids = FlatSamples::U32(pixels.iter().map(|pixel| pixel.id).collect());
    let mut channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::new();
    channels.push(floats("R", &|p| p.color[0]));
    channels.push(floats("G", &|p| p.color[1]));
    channels.push(floats("B", &|p| p.color[2]));
    channels.push(floats("A", &|p| p.color[3]));
    channels.push(floats("depth.Z", &|p| p.depth));
    channels.push(floats("normal.X", &|p| p.normal[0]));
    channels.push(floats("normal.Y", &|p| p.normal[1]));
    channels.push(floats("normal.Z", &|p| p.normal[2]));
    channels.push(AnyChannel::new("id.I", ids));
    if let Some(name) = layer {
        channels.push(floats(name, &|p| p.scalar));
    }
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let size = Vec2(width as usize, height as usize);
    let layer = Layer::new(
        size,
        LayerAttributes::default(),
        encoding,
        AnyChannels::sort(channels),
    );
    Image::from_layer(layer)
        .write()
        .to_buffered(writer)
        .map_err(|error| anyhow!("EXR: {error}"))
}
