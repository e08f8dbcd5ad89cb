//! What a demo is handed: the sizes asked for, and the folder that it fills.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Component, Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, Result, ensure};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::Value;

use super::failure::BadInput;
use crate::export::{Part, Step, gltf, obj};
use crate::figure::Figure;
use crate::image::{Image, write_animation};
use crate::render::{Camera, Options, Picture as RenderedPicture, Scene, render};
use crate::report::{Measured, Picture, Report, Target};

/// Pixels of the largest rendered picture: each takes some 300 bytes while the light on it is smoothed.
const MOST_PIXELS: f64 = 3.0e7;

/// The flags that all demos share.
#[derive(clap::Args, Clone, Debug)]
pub struct Settings {
    /// Folder in which the demo's own folder is made
    #[arg(long, value_name = "DIR", default_value = "target/gallery")]
    pub out: PathBuf,
    /// Width of pictures in pixels [default: 1280, quick 480]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(16..=16384))]
    pub width: Option<u32>,
    /// Height of rendered pictures in pixels [default: three quarters of the width; less for wide scenes]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(16..=16384))]
    pub height: Option<u32>,
    /// Rays per edge pixel of rendered pictures; a quarter inside surfaces [default: 32, quick 8]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536))]
    pub samples: Option<u32>,
    /// Seed of everything random
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Small pictures and few trials
    #[arg(long)]
    pub quick: bool,
}

/// The running demo's sizes, folder and report.
///
/// Nothing is drawn at once that could not be thrown away: a file appears under its name only
/// when it is complete, and `report.json` only when the demo has ended well.
#[derive(Debug)]
pub struct Context {
    settings: Settings,
    folder: PathBuf,
    start: Instant,
    report: Report,
}

impl Context {
    pub(super) fn open(demo: &str, paper: &str, settings: Settings) -> Result<Self> {
        let folder = settings.out.join(demo);
        fs::create_dir_all(&folder)
            .with_context(|| format!("cannot make the folder {}", folder.display()))?;
        // An older run's report must not vouch for this run's files.
        match fs::remove_file(folder.join("report.json")) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error.into()),
            _ => {}
        }
        let report = Report {
            demo: demo.into(),
            paper: paper.into(),
            seconds: 0.0,
            files: Vec::new(),
            pictures: Vec::new(),
            numbers: Vec::new(),
        };
        Ok(Self {
            settings,
            folder,
            start: Instant::now(),
            report,
        })
    }

    pub(super) fn close(mut self) -> Result<Report> {
        self.report.seconds = (self.start.elapsed().as_secs_f64() * 1e3).round() / 1e3;
        let mut text = serde_json::to_string_pretty(&self.report)?;
        text.push('\n');
        write_atomically(&self.folder.join("report.json"), |file| {
            file.write_all(text.as_bytes())
        })?;
        Ok(self.report)
    }

    /// Width of pictures in pixels.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.settings
            .width
            .unwrap_or(if self.quick() { 480 } else { 1280 })
    }

    /// Height of rendered pictures in pixels.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.settings
            .height
            .unwrap_or((self.width() * 3).div_ceil(4))
    }

    /// Rays per edge pixel of rendered pictures.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.settings
            .samples
            .unwrap_or(if self.quick() { 8 } else { 32 })
    }

    /// Seed of everything random.
    #[must_use]
    pub const fn seed(&self) -> u64 {
        self.settings.seed
    }

    /// Whether the run should be small: a few seconds at most, every number still measured.
    #[must_use]
    pub const fn quick(&self) -> bool {
        self.settings.quick
    }

    /// `full`, or `quick` in a quick run: a number of trials, of levels, of frames.
    pub fn pick<T>(&self, full: T, quick: T) -> T {
        if self.quick() { quick } else { full }
    }

    /// Records a number with its target; it is in `report.json` under `key`.
    ///
    /// `value` may be a number, a text or an array (`vec![..]`).
    pub fn number(&mut self, key: &str, value: impl Into<Value>, target: Target) {
        let measured = Measured {
            key: key.into(),
            value: value.into(),
            target,
        };
        self.report.numbers.retain(|known| known.key != key);
        self.report.numbers.push(measured);
    }

    /// Writes a file that `content` fills. `name` is a plain file name with its ending.
    ///
    /// # Errors
    /// A name with a folder in it, and whatever writing reports; no file is left then.
    pub fn file<E: Into<anyhow::Error>>(
        &mut self,
        name: &str,
        content: impl FnOnce(&mut BufWriter<File>) -> std::result::Result<(), E>,
    ) -> Result<()> {
        let mut parts = Path::new(name).components();
        let plain = matches!(
            (parts.next(), parts.next()),
            (Some(Component::Normal(_)), None)
        );
        ensure!(plain, "{name:?} is not a plain file name");
        write_atomically(&self.folder.join(name), content)
            .with_context(|| format!("cannot write {}", self.folder.join(name).display()))?;
        if !self.report.files.iter().any(|known| known == name) {
            self.report.files.push(name.into());
        }
        Ok(())
    }

    /// Writes `text` as a file.
    ///
    /// # Errors
    /// As [`Context::file`].
    pub fn text(&mut self, name: &str, text: &str) -> Result<()> {
        self.file(name, |file| file.write_all(text.as_bytes()))
    }

    /// Writes triangles as `NAME.obj` and `NAME.gltf`.
    ///
    /// # Errors
    /// As [`Context::file`], and as [`Mesh::check`](crate::mesh::Mesh::check).
    pub fn meshes(&mut self, name: &str, parts: &[Part<'_>]) -> Result<()> {
        self.text(&format!("{name}.obj"), &obj(parts)?)?;
        self.text(&format!("{name}.gltf"), &gltf(parts)?)
    }

    /// Writes exact surfaces as `NAME.step`.
    ///
    /// # Errors
    /// As [`Context::file`].
    pub fn step(&mut self, name: &str, step: &Step) -> Result<()> {
        self.text(&format!("{name}.step"), &step.text())
    }

    /// Draws a figure as `NAME.png` and `NAME.svg`. Names start with `figure`.
    ///
    /// `caption` stands under the picture, `alt` describes it for who cannot see it.
    ///
    /// # Errors
    /// As [`Context::file`].
    pub fn figure(&mut self, name: &str, figure: &Figure, caption: &str, alt: &str) -> Result<()> {
        let image = figure.image(self.width());
        self.picture(name, &image, caption, alt)?;
        self.text(&format!("{name}.svg"), &figure.svg(alt))
    }

    /// Writes a finished picture as `NAME.png`.
    ///
    /// # Errors
    /// As [`Context::file`].
    pub fn picture(&mut self, name: &str, image: &Image, caption: &str, alt: &str) -> Result<()> {
        self.file(&format!("{name}.png"), |file| image.write_png(file))?;
        self.show(name, caption, alt);
        Ok(())
    }

    /// Writes frames of equal size as the animated `NAME.png`.
    ///
    /// # Errors
    /// As [`Context::file`], and if there is no frame or the sizes differ.
    pub fn animation(
        &mut self,
        name: &str,
        frames: &[Image],
        frames_per_second: u16,
        caption: &str,
        alt: &str,
    ) -> Result<()> {
        self.file(&format!("{name}.png"), |file| {
            write_animation(frames, frames_per_second, file)
        })?;
        self.show(name, caption, alt);
        Ok(())
    }

    /// Width over height of rendered pictures.
    #[must_use]
    pub fn aspect(&self) -> f64 {
        f64::from(self.width()) / f64::from(self.height())
    }

    /// The same where a picture had better be wider or higher than most: `wished`, unless a height was asked for.
    #[must_use]
    pub fn aspect_or(&self, wished: f64) -> f64 {
        if self.settings.height.is_some() {
            self.aspect()
        } else {
            wished
        }
    }

    /// Renders a scene at the size asked for as `NAME.exr` (with its layers) and `NAME.png`. Names
    /// start with `render`.
    ///
    /// # Errors
    /// As [`Context::file`].
    pub fn render(
        &mut self,
        name: &str,
        scene: &Scene,
        camera: &Camera,
        caption: &str,
        alt: &str,
    ) -> Result<()> {
        let pixels = f64::from(self.width()).powi(2) / camera.aspect();
        ensure!(
            pixels <= MOST_PIXELS,
            BadInput(format!(
                "a rendered picture of {pixels:.0} pixels does not fit: at most {MOST_PIXELS:.0}"
            ))
        );
        let picture = self.rendered(name, scene, camera, self.width(), self.samples());
        self.file(&format!("{name}.exr"), |file| picture.write_exr(file))?;
        self.picture(name, &picture.image(), caption, alt)
    }

    /// One frame of an animation: half the size of a picture and a quarter of its samples, for there are many.
    #[must_use]
    pub fn frame_of(&self, what: &str, scene: &Scene, camera: &Camera) -> RenderedPicture {
        self.rendered(what, scene, camera, self.width() / 2, self.samples() / 4)
    }

    fn rendered(
        &self,
        what: &str,
        scene: &Scene,
        camera: &Camera,
        width: u32,
        samples: u32,
    ) -> RenderedPicture {
        let height = (f64::from(width) / camera.aspect()).round().max(1.0) as u32;
        let options = Options {
            width: width.max(1),
            height,
            samples: samples.max(1),
            seed: self.seed(),
        };
        let bar = self.progress(what, u64::from(height));
        let picture = render(scene, camera, options, |_| bar.inc(1));
        bar.finish_and_clear();
        picture
    }

    fn show(&mut self, name: &str, caption: &str, alt: &str) {
        let file = format!("{name}.png");
        self.report.pictures.retain(|known| known.file != file);
        self.report.pictures.push(Picture {
            file,
            caption: caption.into(),
            alt: alt.into(),
        });
    }

    /// A progress bar over `length` steps; it draws only on a terminal and vanishes when dropped.
    #[must_use]
    pub fn progress(&self, what: &str, length: u64) -> ProgressBar {
        progress_bar(&format!("{}: {what}", self.report.demo), length)
    }
}

/// The one look of all progress bars.
pub(crate) fn progress_bar(what: &str, length: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::stderr_with_hz(10));
    if let Ok(style) =
        ProgressStyle::with_template("{msg:32} {wide_bar:.blue/white} {pos:>5}/{len} {eta:>4}")
    {
        bar.set_style(style);
    }
    bar.set_message(what.to_owned());
    bar
}

/// Writes under a temporary name beside `path` and renames; on failure nothing is left.
pub(crate) fn write_atomically<E: Into<anyhow::Error>>(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> std::result::Result<(), E>,
) -> Result<()> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.part", std::process::id()));
    let temporary = path.with_file_name(name);
    let write = || -> Result<()> {
        let mut writer = BufWriter::new(File::create(&temporary)?);
        content(&mut writer).map_err(Into::into)?;
        writer
            .into_inner()
            .map_err(io::IntoInnerError::into_error)?
            .sync_all()?;
        fs::rename(&temporary, path)?;
        Ok(())
    };
    write().inspect_err(|_| {
        // The failure itself is what the caller must hear of.
        let _ = fs::remove_file(&temporary);
    })
}

#[cfg(test)]
mod tests;
