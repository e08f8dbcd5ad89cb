//! From numbers to lengths on the page, and the numbers worth a tick.

/// How an axis spreads its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scale {
    Linear,
    Log,
}

/// A tick: its number and its text; without a text it is a minor one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) text: String,
}

impl Scale {
    /// The number as a length; NaN where a logarithm does not exist.
    pub(super) fn length(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log if value > 0.0 => value.log10(),
            Self::Log => f64::NAN,
        }
    }

    /// Ticks between two lengths, about `wanted` of them.
    pub(super) fn ticks(self, low: f64, high: f64, wanted: f64) -> Vec<Tick> {
        match self {
            Self::Linear => linear_ticks(low, high, wanted),
            // Of half a decade most tenths are missing: even steps then.
            Self::Log if high - low < 0.5 => {
                linear_ticks(10_f64.powf(low), 10_f64.powf(high), wanted)
            }
            // Less than two decades: their tenths, as numbers.
            Self::Log if high - low < 1.5 => log_tenths(low, high),
            Self::Log => decades(low, high, wanted),
        }
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `step`.
fn round_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    let factor = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|f| f * power >= step * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * power
}

fn linear_ticks(low: f64, high: f64, wanted: f64) -> Vec<Tick> {
    let step = round_step((high - low) / wanted.max(1.0));
    if !step.is_finite() || step <= 0.0 {
        return Vec::new();
    }
    let digits = (-step.log10().floor()).clamp(0.0, 12.0) as usize;
    let large = low.abs().max(high.abs()) >= 1e6 || step < 1e-5;
    let (first, last) = (
        (low / step - 1e-9).ceil() as i64,
        (high / step + 1e-9).floor() as i64,
    );
    (first..=last.min(first.saturating_add(100)))
        .map(|i| {
            let value = i as f64 * step;
            let text = if i == 0 {
                "0".into()
            } else if large {
                format!("{value:.1e}").replace(".0e", "e").replace('-', "−")
            } else {
                format!("{value:.digits$}").replace('-', "−")
            };
            Tick { value, text }
        })
        .collect()
}

fn decades(low: f64, high: f64, wanted: f64) -> Vec<Tick> {
    let every = ((high - low) / wanted.max(1.0)).ceil().max(1.0) as i32;
    let exponents = (low - 1e-9).ceil() as i32..=(high + 1e-9).floor() as i32;
    exponents
        .map(|exponent| Tick {
            value: 10_f64.powi(exponent),
            text: if exponent.rem_euclid(every) == 0 {
                power_of_ten(exponent)
            } else {
                String::new()
            },
        })
        .collect()
}

fn log_tenths(low: f64, high: f64) -> Vec<Tick> {
    let mut ticks = Vec::new();
    for exponent in low.floor() as i32..=high.floor() as i32 {
        for digit in 1..10 {
            let value = f64::from(digit) * 10_f64.powi(exponent);
            if (low - 1e-9..=high + 1e-9).contains(&value.log10()) {
                let text = if matches!(digit, 1 | 2 | 5) {
                    crate::report::plain(&value.into())
                } else {
                    String::new()
                };
                ticks.push(Tick { value, text });
            }
        }
    }
    ticks
}

/// `10⁻⁶`, and the plain numbers around one.
fn power_of_ten(exponent: i32) -> String {
    match exponent {
        0 => "1".into(),
        1 => "10".into(),
        _ => {
            let digits = exponent.to_string();
            let raised = digits.chars().map(|c| match c {
                '-' => '⁻',
                '1' => '¹',
                '2' => '²',
                '3' => '³',
                other => char::from_u32(0x2070 + other.to_digit(10).unwrap_or(0)).unwrap_or(other),
            });
            "10".chars().chain(raised).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(ticks: &[Tick]) -> Vec<&str> {
        ticks
            .iter()
            .map(|t| t.text.as_str())
            .filter(|t| !t.is_empty())
            .collect()
    }

    #[test]
    fn ticks_are_round() {
        assert_eq!(
            texts(&Scale::Linear.ticks(-1.0, 1.0, 4.0)),
            ["−1.0", "−0.5", "0", "0.5", "1.0"]
        );
        assert_eq!(
            texts(&Scale::Linear.ticks(0.0, 100.0, 6.0)),
            ["0", "20", "40", "60", "80", "100"]
        );
        assert_eq!(
            texts(&Scale::Log.ticks(-6.0, 1.0, 4.0)),
            ["10⁻⁶", "10⁻⁴", "10⁻²", "1"]
        );
        assert_eq!(
            texts(&Scale::Log.ticks(0.0, 1.0, 4.0)),
            ["1", "2", "5", "10"]
        );
        assert!(Scale::Linear.ticks(0.0, 0.0, 4.0).is_empty());
        assert!(Scale::Linear.ticks(f64::NAN, 1.0, 4.0).is_empty());
    }
}
