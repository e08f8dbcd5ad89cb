//! Ray codes: the interfaces that a wave meets, and what happens there.

use crate::{Error, Mode, Model};

/// One step of a ray code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Step {
    /// The interface that is met.
    pub interface: usize,
    /// What happens there.
    pub mode: Mode,
}

/// The history of a wave: the interfaces that it meets in order, and what happens there.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Code {
    /// The steps in order; none for the direct wave.
    pub steps: Vec<Step>,
}

impl Model {
    /// The medium in which a wave from `layer` runs after each step of a code.
    ///
    /// # Errors
    /// [`Error::BadCode`] for an interface that does not bound the wave's medium.
    pub fn layers_along(&self, layer: usize, code: &Code) -> Result<Vec<usize>, Error> {
        let mut layers = vec![layer];
        let mut layer = layer;
        for (step, &Step { interface, mode }) in code.steps.iter().enumerate() {
            if interface >= self.interfaces().len() {
                return Err(Error::BadCode {
                    step,
                    reason: "there is no such interface",
                });
            }
            layer = match (mode, layer) {
                (Mode::Transmit, layer) if layer == interface => interface + 1,
                (Mode::Transmit, layer) if layer == interface + 1 => interface,
                (Mode::Reflect, layer) if layer == interface || layer == interface + 1 => layer,
                _ => {
                    return Err(Error::BadCode {
                        step,
                        reason: "the interface does not bound the medium of the wave",
                    });
                }
            };
            layers.push(layer);
        }
        Ok(layers)
    }

    /// All codes of a wave from `layer`, up to `depth` steps: the direct wave, reflections, transmissions and multiples.
    #[must_use]
    pub fn codes(&self, layer: usize, depth: usize) -> Vec<Code> {
        let mut codes = vec![Code::default()];
        let mut ends = vec![(Code::default(), layer)];
        for _ in 0..depth {
            let mut longer = Vec::new();
            for (code, layer) in &ends {
                let met_last = code.steps.last().map(|step| step.interface);
                for interface in [layer.checked_sub(1), Some(*layer)].into_iter().flatten() {
                    // Straight lines do not meet a boundary of their layer twice in a row, but curves do: from inside.
                    if interface >= self.interfaces().len() || met_last == Some(interface) {
                        continue;
                    }
                    for mode in [Mode::Reflect, Mode::Transmit] {
                        let mut code = code.clone();
                        code.steps.push(Step { interface, mode });
                        if let Ok(layers) = self.layers_along(
                            *layer,
                            &Code {
                                steps: vec![Step { interface, mode }],
                            },
                        ) {
                            longer.push((code.clone(), layers[1]));
                            codes.push(code);
                        }
                    }
                }
            }
            ends = longer;
        }
        codes
    }
}
