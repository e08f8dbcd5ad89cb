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

use super::picture::Picture;

pub(super) fn write(picture: &Picture, writer: impl Write + Seek) -> Result<()> {
    let floats = |name: &str, values: Vec<f32>| AnyChannel::new(name, FlatSamples::F32(values));
    let color = |channel: usize| picture.colors().map(move |color| color[channel]).collect();
    let normal = |axis: usize| picture.normals().map(move |normal| normal[axis]).collect();
    let mut channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::new();
    for (channel, name) in ["R", "G", "B", "A"].into_iter().enumerate() {
        channels.push(floats(name, color(channel)));
    }
    channels.push(floats("depth.Z", picture.depths().collect()));
    for (axis, name) in ["normal.X", "normal.Y", "normal.Z"].into_iter().enumerate() {
        channels.push(floats(name, normal(axis)));
    }
    channels.push(AnyChannel::new(
        "id.I",
        FlatSamples::U32(picture.ids().collect()),
    ));
    if let Some(name) = picture.layer_name() {
        channels.push(floats(name, picture.scalars().collect()));
    }
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let [width, height] = picture.size();
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
