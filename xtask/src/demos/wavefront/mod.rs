//! Waves in a layered model with curved interfaces: rays, fronts at successive times, and what receivers hear.
//!
//! What one sees: three media, darker where the wave is faster, between two curved interfaces, a source (red) and a line of
//! receivers. In the upper plot the rays that come back, a colour for each history: reflected at the first interface, at the
//! second, or back and forth between the two. In the lower one all fronts at a few times; they are bent, cut and folded at the
//! interfaces. The second figure is the section, arrival time against receiver: bow ties where the caustic of a valley lies.
//! The animation shows the fronts running.

mod model;
mod pictures;
mod section;
mod shooting;
mod survey;

use std::path::PathBuf;

use anyhow::Result;

use crate::demo::{Context, Demo, OrBadInput as _};
use crate::report::Target;

use model::Description;
use survey::Survey;

#[derive(clap::Args, Debug)]
pub(super) struct Wavefront {
    /// A model: {"box": [[x, y], [x, y]], "media": [{"speed": v}, {"semi_axes": [a, b], "angle": radians}, ..] from above,
    /// "interfaces": [{"line": [[x, y], [x, y]]}, {"graph": [[x, y], ..]}, ..], "source": [x, y], "receivers": [[x, y], [x, y]]}
    #[arg(long, value_name = "FILE.json")]
    model: Option<PathBuf>,
    /// Longest history of a wave, in interfaces met
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=8))]
    depth: u32,
}

impl Demo for Wavefront {
    const NAME: &'static str = "wavefront";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 5.3 to 5.7";
    const ABOUT: &'static str =
        "Rays, fronts and arrivals in a layered model with curved interfaces";

    fn run(&self, context: &mut Context) -> Result<()> {
        let description = match &self.model {
            Some(path) => {
                let text = std::fs::read_to_string(path).or_bad_input("--model")?;
                serde_json::from_str(&text).or_bad_input("--model")?
            }
            None => Description::valleys(),
        };
        let survey = Survey::new(&description).or_bad_input("--model")?;
        let depth = self.depth as usize;
        let codes = survey.model.codes(survey.layer, depth);
        let returning = survey.fans(codes.iter().filter(|code| survey.returns(code)))?;
        // The fronts of long histories would only cover the picture.
        let short = codes.iter().filter(|code| code.steps.len() <= 3);
        let all = survey.fans(short)?;
        let fronts = survey.fronts(&all)?;

        survey.draw(context, &returning, &all, &fronts)?;
        survey.draw_section(context, &returning)?;
        survey.animate(context, &all, &fronts)?;

        let check =
            survey.check_arrivals(&returning, context.pick(41, 7), context.pick(4000, 1200));
        context.number("arrival_max_error", check.largest, Target::AtMost(1e-9));
        context.number("missed_arrivals", check.missed, Target::exactly(0));
        context.number("arrivals_compared", check.compared, Target::AtLeast(1.0));
        let distance = survey.front_distance(&all, &fronts, context.pick(60, 12))?;
        context.number("front_max_distance", distance, Target::AtMost(1e-6));
        let pieces: usize = fronts.iter().map(|(_, front)| front.pieces().len()).sum();
        context.number("arcs", pieces, Target::AtLeast(1.0));
        let angle = fronts
            .iter()
            .map(|(_, front)| front.joint_errors().0)
            .fold(0.0, f64::max);
        context.number("g1_max_angle_rad", angle, Target::AtMost(1e-9));
        Ok(())
    }
}
