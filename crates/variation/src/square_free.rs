//! Square-free decomposition (D. Y. Y. Yun, SYMSAC 1976) of integer polynomials, and the arithmetic that it needs.

use num_bigint::{BigInt, BigUint, Sign};

pub(crate) fn gcd_integers(a: &BigInt, b: &BigInt) -> BigInt {
    let (mut a, mut b) = (a.magnitude().clone(), b.magnitude().clone());
    while b != BigUint::ZERO {
        let r = &a % &b;
        a = b;
        b = r;
    }
    BigInt::from(a)
}

pub(crate) fn derivative(f: &[BigInt]) -> Vec<BigInt> {
    f.iter().enumerate().skip(1).map(|(i, c)| c * i).collect()
}

/// Divides by the common divisor of all coefficients.
fn primitive(mut f: Vec<BigInt>) -> Vec<BigInt> {
    while f.last().is_some_and(|c| *c == BigInt::ZERO) {
        f.pop();
    }
    let mut content = BigInt::ZERO;
    for c in &f {
        content = gcd_integers(c, &content);
        if content == BigInt::from(1) {
            return f;
        }
    }
    if content != BigInt::ZERO {
        for c in &mut f {
            *c /= &content;
        }
    }
    f
}

/// Remainder of a positive or negative multiple of `f` by `g` (the sign does not matter for a divisor).
fn pseudo_remainder(mut f: Vec<BigInt>, g: &[BigInt]) -> Vec<BigInt> {
    let Some(lead) = g.last() else { return f };
    while f.len() >= g.len() {
        let Some(top) = f.pop() else { break };
        let shift = f.len() + 1 - g.len();
        for c in &mut f {
            *c *= lead;
        }
        for (i, c) in g[..g.len() - 1].iter().enumerate() {
            f[shift + i] -= &top * c;
        }
        while f.last().is_some_and(|c| *c == BigInt::ZERO) {
            f.pop();
        }
    }
    f
}

/// Greatest common divisor by primitive remainders.
fn gcd(f: &[BigInt], g: &[BigInt]) -> Vec<BigInt> {
    let (mut f, mut g) = (primitive(f.to_vec()), primitive(g.to_vec()));
    while !g.is_empty() {
        let r = primitive(pseudo_remainder(f, &g));
        f = g;
        g = r;
    }
    f
}

/// `f / g` for a primitive divisor `g`, exact.
fn quotient(f: &[BigInt], g: &[BigInt]) -> Vec<BigInt> {
    let mut f = f.to_vec();
    let mut result = Vec::new();
    if let Some(lead) = g.last() {
        while f.len() >= g.len() {
            let Some(top) = f.pop() else { break };
            let factor = top / lead;
            let shift = f.len() + 1 - g.len();
            for (i, c) in g[..g.len() - 1].iter().enumerate() {
                f[shift + i] -= &factor * c;
            }
            result.push(factor);
        }
    }
    result.reverse();
    result
}

/// Yun's decomposition: square-free factors with their multiplicities, constants left out.
pub(crate) fn square_free(f: Vec<BigInt>) -> Vec<(Vec<BigInt>, u32)> {
    if f.len() <= 1 {
        return Vec::new();
    }
    if coprime_modulo(&f, &derivative(&f)) {
        return vec![(f, 1)];
    }
    let f = primitive(f);
    let slope = derivative(&f);
    let common = gcd(&f, &slope);
    let mut rest = quotient(&f, &common);
    let mut other = quotient(&slope, &common);
    let mut factors = Vec::new();
    let mut multiplicity = 1;
    while rest.len() > 1 {
        let mut difference = other;
        let own = derivative(&rest);
        difference.resize(difference.len().max(own.len()), BigInt::ZERO);
        for (d, c) in difference.iter_mut().zip(own) {
            *d -= c;
        }
        while difference.last().is_some_and(|c| *c == BigInt::ZERO) {
            difference.pop();
        }
        let factor = if difference.is_empty() {
            rest.clone()
        } else {
            gcd(&rest, &difference)
        };
        rest = quotient(&rest, &factor);
        other = quotient(&difference, &factor);
        if factor.len() > 1 {
            factors.push((factor, multiplicity));
        }
        multiplicity += 1;
    }
    factors
}

/// The prime `2^61 - 1`.
const PRIME: u64 = (1 << 61) - 1;

/// Whether `f` and `g` are coprime modulo a prime that divides neither leading coefficient: then they are coprime.
fn coprime_modulo(f: &[BigInt], g: &[BigInt]) -> bool {
    let residues = |f: &[BigInt]| -> Vec<u64> {
        f.iter()
            .map(|c| {
                let r = (c.magnitude() % PRIME)
                    .iter_u64_digits()
                    .next()
                    .unwrap_or(0);
                if c.sign() == Sign::Minus && r > 0 {
                    PRIME - r
                } else {
                    r
                }
            })
            .collect()
    };
    let (mut f, mut g) = (residues(f), residues(g));
    if f.last() == Some(&0) || g.last() == Some(&0) {
        return false;
    }
    loop {
        while g.last() == Some(&0) {
            g.pop();
        }
        match g.len() {
            0 => return false,
            1 => return true,
            _ => {}
        }
        // f modulo g, division-free.
        let lead = g[g.len() - 1];
        while f.len() >= g.len() {
            let Some(top) = f.pop() else { break };
            let shift = f.len() + 1 - g.len();
            for c in &mut f {
                *c = multiply(*c, lead);
            }
            for (i, c) in g[..g.len() - 1].iter().enumerate() {
                let d = multiply(top, *c);
                let value = &mut f[shift + i];
                *value = if *value >= d {
                    *value - d
                } else {
                    *value + PRIME - d
                };
            }
        }
        std::mem::swap(&mut f, &mut g);
    }
}

fn multiply(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    let folded = (product & u128::from(PRIME)) as u64 + (product >> 61) as u64;
    if folded >= PRIME {
        folded - PRIME
    } else {
        folded
    }
}
