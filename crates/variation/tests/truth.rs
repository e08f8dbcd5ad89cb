//! The solver against proofs and Sturm's theorem: every answer is judged on the exact roots of the rounded input.
#![cfg(feature = "exact")]

use variation::sets::{Set, SplitMix64};
use variation::{Solver, SturmChain, Verdict};

fn judge(solver: &mut Solver, coefficients: &[f64], what: &str) {
    let roots = solver.roots(coefficients).unwrap();
    assert_eq!(
        Verdict::of(coefficients, roots).unwrap(),
        Verdict::default(),
        "{what}: {coefficients:?} gives {roots:?}"
    );
    assert!(
        roots.iter().all(|root| root.width() <= 1e-12),
        "{what}: {roots:?}"
    );
    assert!(roots.is_sorted_by(|a, b| a.lo <= b.lo), "{what}: {roots:?}");
}

/// 20,000 polynomials of degree 1 to 20 with planted roots: single, double, clustered to 1e-9, and at the ends.
#[test]
fn planted_roots() {
    let mut random = SplitMix64::new(20_000);
    let mut solver = Solver::new();
    for k in 0..20_000 {
        let polynomial = variation::sets::planted(1 + k % 20, &mut random);
        judge(&mut solver, &polynomial, &format!("planted {k}"));
        if k % 40 == k / 1000 {
            let chain = SturmChain::try_new(&polynomial).unwrap();
            let verdict = chain.judge(solver.roots(&polynomial).unwrap());
            assert_eq!(verdict, Verdict::default(), "planted {k}: {polynomial:?}");
        }
    }
}

#[test]
fn benchmark_sets() {
    let mut solver = Solver::new();
    for set in Set::ALL {
        for degree in [2, 3, 4, 5, 6, 7, 8, 12, 16, 20] {
            for index in 0..set.items().min(20) {
                let polynomial = set.polynomial(degree, index);
                judge(
                    &mut solver,
                    &polynomial,
                    &format!("{set:?} {degree} {index}"),
                );
            }
        }
    }
}

#[test]
fn high_degrees() {
    let mut solver = Solver::new();
    let mut check = |set: Set, degree: usize| {
        judge(
            &mut solver,
            &set.polynomial(degree, 0),
            &format!("{set:?} {degree}"),
        );
    };
    for set in Set::ALL {
        for degree in [30, 40, 50, 60] {
            check(set, degree);
        }
    }
}

/// Few nonzero coefficients, of very different size.
#[test]
fn sparse() {
    let mut random = SplitMix64::new(60);
    let mut solver = Solver::new();
    for degree in (2..=60).step_by(2) {
        for _ in 0..4 {
            let mut polynomial = vec![0.0; degree + 1];
            for _ in 0..4 {
                let place = (random.bits() % (degree as u64 + 1)) as usize;
                polynomial[place] =
                    (random.unit() - 0.5) * 2.0_f64.powi((random.bits() % 60) as i32 - 30);
            }
            judge(&mut solver, &polynomial, &format!("sparse {degree}"));
        }
    }
}

/// Small integer coefficients: many exact zeros, roots at split points, multiple roots.
#[test]
fn small_integers() {
    let mut random = SplitMix64::new(7);
    let mut solver = Solver::new();
    for k in 0..5_000_usize {
        let polynomial: Vec<f64> = (0..=1 + k % 8)
            .map(|_| (random.bits() % 7) as f64 - 3.0)
            .collect();
        if polynomial.iter().any(|p| *p != 0.0) {
            judge(&mut solver, &polynomial, &format!("integers {k}"));
        }
    }
}

/// Degrees 3 to 5 near every decision of the direct paths: small integers, and the same moved by little.
#[test]
fn nearly_degenerate_polynomials_of_low_degree() {
    let mut random = SplitMix64::new(3);
    let mut solver = Solver::new();
    for k in 0..30_000_usize {
        let polynomial: Vec<f64> = (0..=3 + k % 3)
            .map(|_| {
                let moved = 2.0_f64.powi(-((random.bits() % 60) as i32)) * (random.unit() - 0.5);
                (random.bits() % 7) as f64 - 3.0 + if k % 2 == 0 { moved } else { 0.0 }
            })
            .collect();
        if polynomial.iter().any(|p| *p != 0.0) {
            judge(&mut solver, &polynomial, &format!("low degree {k}"));
        }
    }
}
