//! Reproducible benchmark polynomials.
//!
//! Eight families of Bernstein polynomials on `[0, 1]`, easy and hostile, each item determined bit by bit by its set,
//! degree and index (`splitmix64`, plain `f64`, no fused multiply-add). The figures of this crate are measured on them.

/// A family of polynomials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Set {
    /// `U`: coefficients uniform in `[-1, 1]`.
    Uniform,
    /// `K`: half of the roots uniform in `[0, 1]`, the others complex.
    Known,
    /// `A`: all roots uniform in `[0, 1]`.
    AllReal,
    /// `W`: roots `j / (n + 1)`, the Wilkinson polynomial. One item.
    Wilkinson,
    /// `C`: the Chebyshev polynomial on `[0, 1]`. One item.
    Chebyshev,
    /// `M`: the Mignotte polynomial `t^n - 2 (A t - 1)^2` with a random integer `A` of 3 to 63.
    Mignotte,
    /// `L`: up to three pairs of roots at most `2^-16` apart, the others complex.
    ClosePairs,
    /// `F`: no real root in `[0, 1]`.
    RootFree,
}

impl Set {
    /// All sets.
    pub const ALL: [Self; 8] = [
        Self::Uniform,
        Self::Known,
        Self::AllReal,
        Self::Wilkinson,
        Self::Chebyshev,
        Self::Mignotte,
        Self::ClosePairs,
        Self::RootFree,
    ];

    /// The letter that names the set.
    #[must_use]
    pub const fn letter(self) -> char {
        match self {
            Self::Uniform => 'U',
            Self::Known => 'K',
            Self::AllReal => 'A',
            Self::Wilkinson => 'W',
            Self::Chebyshev => 'C',
            Self::Mignotte => 'M',
            Self::ClosePairs => 'L',
            Self::RootFree => 'F',
        }
    }

    /// The set named by a letter.
    #[must_use]
    pub fn from_letter(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|set| set.letter() == letter)
    }

    /// How many items are measured: 100, or 1 where there is nothing random.
    #[must_use]
    pub const fn items(self) -> u64 {
        match self {
            Self::Wilkinson | Self::Chebyshev => 1,
            _ => 100,
        }
    }

    /// The `index`-th polynomial of this degree (2 to 60), by its `degree + 1` Bernstein coefficients on `[0, 1]`.
    #[must_use]
    pub fn polynomial(self, degree: usize, index: u64) -> Vec<f64> {
        let n = degree;
        let id = self as u64 + 1;
        let mut random = SplitMix64::new(
            0x5EED_0000_0000_0000_u64.wrapping_add((id << 32) + ((n as u64) << 16) + index),
        );
        match self {
            Self::Uniform => (0..=n).map(|_| 2.0 * random.unit() - 1.0).collect(),
            Self::Known => {
                let mut p = Product::new();
                for _ in 0..n / 2 {
                    p.root(random.unit());
                }
                p.complete(n - n / 2, 0.05, 0.95, &mut random)
            }
            Self::AllReal => {
                let mut p = Product::new();
                for _ in 0..n {
                    p.root(random.unit());
                }
                p.normalised()
            }
            Self::Wilkinson => {
                let mut p = Product::new();
                for j in 1..=n {
                    p.root(j as f64 / (n + 1) as f64);
                }
                p.normalised()
            }
            Self::Chebyshev => chebyshev(n),
            Self::Mignotte => mignotte(n, 3 + (61.0 * random.unit()) as i64),
            Self::ClosePairs => {
                let pairs = (n / 2).min(3);
                let mut p = Product::new();
                for _ in 0..pairs {
                    let centre = random.unit();
                    let gap = random.unit() * 2.0_f64.powi(-16);
                    p.root(centre);
                    p.root(centre + gap);
                }
                p.complete(n - 2 * pairs, 0.05, 0.95, &mut random)
            }
            Self::RootFree => Product::new().complete(n, 0.02, 0.28, &mut random),
        }
    }
}

/// A random polynomial of this degree with planted roots in `[0, 1]`: single, double, clustered down to `1e-9` apart, at the
/// ends, complex and outside; rounded, so that its exact roots are near the planted ones only.
#[must_use]
pub fn planted(degree: usize, random: &mut SplitMix64) -> Vec<f64> {
    let mut product = Product::new();
    while product.degree() < degree {
        let missing = degree - product.degree();
        let root = match random.bits() % 8 {
            // Dyadic roots survive the rounding, double ones included.
            0 => (random.bits() % 17) as f64 / 16.0,
            _ => random.unit(),
        };
        match random.bits() % 10 {
            0 | 1 if missing >= 2 => {
                product.root(root);
                product.root(root);
            }
            2 | 3 if missing >= 2 => {
                product.root(root);
                product.root(root + 10.0_f64.powi(-((random.bits() % 9) as i32 + 1)));
            }
            4 => product.root(0.0),
            5 => product.root(1.0),
            6 if missing >= 2 => product.complex_pair(root, 1e-6 + random.unit()),
            7 => product.root(-1.0 - random.unit()),
            _ => product.root(root),
        }
    }
    product.normalised()
}

/// The generator `splitmix64` (Steele, Lea and Flood 2014).
#[derive(Clone, Copy, Debug)]
pub struct SplitMix64 {
    state: u64,
}

impl SplitMix64 {
    /// Starts at `state`.
    #[must_use]
    pub const fn new(state: u64) -> Self {
        Self { state }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in `[0, 1)`, a multiple of `2^-53`.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2.0_f64.powi(-53)
    }
}

/// A product of linear and quadratic factors in Bernstein form.
#[derive(Clone, Debug)]
struct Product(Vec<f64>);

impl Product {
    fn new() -> Self {
        Self(vec![1.0])
    }

    fn degree(&self) -> usize {
        self.0.len() - 1
    }

    /// Multiplies by `t - r`.
    fn root(&mut self, r: f64) {
        let m = self.0.len() - 1;
        let b = |k: usize| self.0[k];
        self.0 = (0..=m + 1)
            .map(|k| {
                let mut sum = 0.0;
                if k <= m {
                    sum += (m + 1 - k) as f64 * b(k) * -r;
                }
                if k >= 1 {
                    sum += k as f64 * b(k - 1) * (1.0 - r);
                }
                sum / (m + 1) as f64
            })
            .collect();
    }

    /// Multiplies by `(t - re)^2 + im^2`.
    fn complex_pair(&mut self, re: f64, im: f64) {
        let m = self.0.len() - 1;
        let b = |k: usize| self.0[k];
        let q0 = re * re + im * im;
        let q1 = q0 - re;
        let q2 = (1.0 - re) * (1.0 - re) + im * im;
        self.0 = (0..=m + 2)
            .map(|k| {
                let mut sum = 0.0;
                if k <= m {
                    sum += ((m + 2 - k) * (m + 1 - k)) as f64 * b(k) * q0;
                }
                if k >= 1 && k <= m + 1 {
                    sum += (2 * k * (m + 2 - k)) as f64 * b(k - 1) * q1;
                }
                if k >= 2 {
                    sum += (k * (k - 1)) as f64 * b(k - 2) * q2;
                }
                sum / ((m + 2) * (m + 1)) as f64
            })
            .collect();
    }

    /// Raises the degree by `missing` with complex pairs, and a root outside `[0, 1]` if that is odd.
    fn complete(
        mut self,
        missing: usize,
        im_least: f64,
        im_range: f64,
        random: &mut SplitMix64,
    ) -> Vec<f64> {
        for _ in 0..missing / 2 {
            let re = random.unit();
            let im = im_least + im_range * random.unit();
            self.complex_pair(re, im);
        }
        if missing % 2 == 1 {
            let r = -1.0 - random.unit();
            self.root(r);
        }
        self.normalised()
    }

    fn normalised(self) -> Vec<f64> {
        let largest = self.0.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
        self.0.into_iter().map(|p| p / largest).collect()
    }
}

/// `(-1)^(n-k) C(2n,2k) / C(n,k)`, each rounded once.
fn chebyshev(n: usize) -> Vec<f64> {
    (0..=n)
        .map(|k| {
            let magnitude = rounded_quotient(binomial(2 * n, 2 * k), binomial(n, k));
            if (n - k) % 2 == 1 {
                -magnitude
            } else {
                magnitude
            }
        })
        .collect()
}

/// `t^n - 2 (A t - 1)^2`: integer numerators, one division each.
fn mignotte(n: usize, a: i64) -> Vec<f64> {
    let m = n as i64;
    (0..=m)
        .map(|k| {
            let lead = if k == m { m * (m - 1) } else { 0 };
            let square = 2 * m * (m - 1) - 4 * a * k * (m - 1) + 2 * a * a * k * (k - 1);
            (lead - square) as f64 / (m * (m - 1)) as f64
        })
        .collect()
}

fn binomial(n: usize, k: usize) -> u128 {
    (0..k as u128).fold(1, |c, i| c * (n as u128 - i) / (i + 1))
}

/// `p / q` rounded to nearest, for `q < 2^64` and `p / q >= 1`.
fn rounded_quotient(p: u128, q: u128) -> f64 {
    let (mut digits, mut rest) = (p / q, p % q);
    let mut exponent = 0;
    // 60 bits and a sticky one decide the rounding; the sum of both fits, since the quotient is an integer part of `p`.
    while digits < 1 << 60 {
        rest <<= 1;
        digits = (digits << 1) | u128::from(rest >= q);
        if rest >= q {
            rest -= q;
        }
        exponent -= 1;
    }
    let sticky = u128::from(rest > 0);
    ((digits << 1 | sticky) as f64) * 2.0_f64.powi(exponent - 1)
}
