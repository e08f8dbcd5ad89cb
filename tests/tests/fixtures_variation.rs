//! The reference cases of crate `variation`: polar derivatives, bounds, isolation, lines and implicit curves.
//!
//! All numbers of the file are exact, so the exact entry of the crate answers, and answers are compared with `==`; where all
//! inputs are dyadic, `f64` answers as well.

use integration_tests::{Case, Tolerance, judge, list_at, read};
use serde_json::Value;
use variation::sets::Set;
use variation::{
    BigInt, BigRational, Curve, Error, ExactCurve, ExactPolynomial, ExactRoot, ImplicitCurve,
    Interval, Line, Root, Term, blossom, chain_bound, corollary_bound, descartes_changes,
    polar_derivative, pole_bound, roots_on, sign_changes, sign_changes_by_parity,
    sign_changes_left, sign_changes_right,
};

/// Width of a refined enclosure, and the largest distance to the listed value, relative to the interval.
const ROOT_TOLERANCE: &str = "1e-12";

/// The listed values are rounded to 40 decimals.
const VALUE_ROUNDING: &str = "1e-40";

/// Relative tolerance of points of hits.
const POINT_TOLERANCE: &str = "1e-11";

/// Width of the enclosures at which points of hits are taken: leaves room for speeds of 10,000 times the size.
const POINT_PARAMETER_TOLERANCE: f64 = 1e-15;

#[test]
fn fixtures_variation() {
    let file = read("variation");
    let cases = list_at(&file, "cases").iter().map(|value| {
        Case::new(
            value["name"].as_str().expect("name"),
            value["kind"].as_str().expect("kind"),
            &value["input"],
        )
        .expecting(&value["expected"], Tolerance::Componentwise(0.0))
    });
    judge("variation", cases, answer);
}

fn answer(case: &Case<'_>) {
    let result = match case.kind() {
        "polar" => polar(case),
        "blossom" => blossom_value(case),
        "signs" => signs(case),
        "ineq42" => inequality(case),
        "corollary" => corollary(case),
        "subpolys" => subpolynomials(case),
        "chain" => chain(case),
        "isolate" => isolate(case),
        "generator" => generator(case),
        "line" => line(case),
        "implicit" => implicit(case),
        _ => {
            case.unknown_kind();
            Ok(())
        }
    };
    if let Err(error) = result {
        refuse(case, error);
    }
}

/// The words of the file for each refusal.
fn refuse(case: &Case<'_>, error: Error) {
    let part = match error {
        Error::NoCoefficients => "no coefficients",
        Error::NotFinite { .. } => "not finite",
        Error::EmptyInterval { .. } => "a < b",
        Error::IdenticallyZero => "identically zero",
        Error::PolarOfConstant => "degree at least 1",
        Error::PoleOutside { .. } => "outside the interval",
        Error::TooManyPoles { .. } => "more poles",
        Error::IndexOrder { .. } => "k <= l",
        Error::BlossomArity { .. } => "arguments",
        Error::NoControlPoints => "no control points",
        Error::WeightCount { .. } => "differ in number",
        Error::WeightNotPositive { .. } => "must be positive",
        Error::ZeroNormal => "zero normal",
        Error::LiesOn => "lies on",
        _ => "none of the file's words",
    };
    case.refuse(&error.to_string(), |words| words.contains(part));
}

/// A number of the file: integer, `p/q`, decimal or hex float; `None` for `nan` and `inf`.
fn exact(text: &str) -> Option<BigRational> {
    let (sign, magnitude) = match text.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    let power = |base: i64, exponent: i64| {
        let power =
            BigInt::from(base).pow(u32::try_from(exponent.unsigned_abs()).expect("exponent"));
        if exponent < 0 {
            BigRational::new(BigInt::from(1), power)
        } else {
            BigRational::from(power)
        }
    };
    let value = if let Some(hex) = magnitude.strip_prefix("0x") {
        let (digits, exponent) = hex.split_once('p').expect("binary exponent");
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let mantissa =
            BigInt::parse_bytes(format!("{whole}{fraction}").as_bytes(), 16).expect("hex digits");
        let exponent: i64 = exponent.parse().expect("exponent");
        BigRational::from(mantissa) * power(2, exponent - 4 * fraction.len() as i64)
    } else if let Some((p, q)) = magnitude.split_once('/') {
        BigRational::new(
            p.parse().expect("numerator"),
            q.parse().expect("denominator"),
        )
    } else {
        let (digits, exponent) = magnitude.split_once(['e', 'E']).unwrap_or((magnitude, "0"));
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let mantissa = BigInt::parse_bytes(format!("{whole}{fraction}").as_bytes(), 10)?;
        let exponent: i64 = exponent.parse().expect("exponent");
        BigRational::from(mantissa) * power(10, exponent - fraction.len() as i64)
    };
    Some(value * BigInt::from(sign))
}

fn number(text: &str) -> BigRational {
    exact(text).unwrap_or_else(|| panic!("{text} is not a number"))
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a number as text")
}

fn list<'a>(value: &'a Value) -> Vec<&'a str> {
    value
        .as_array()
        .expect("a list")
        .iter()
        .map(text)
        .collect::<Vec<&'a str>>()
}

/// The numbers of a list, or the error that the crate's `f64` entry gives for one that is not finite.
fn finite(texts: &[&str]) -> Result<Vec<BigRational>, Error> {
    let special = |text: &&str| match *text {
        "nan" => f64::NAN,
        "inf" | "+inf" => f64::INFINITY,
        _ => f64::NEG_INFINITY,
    };
    if let Some(bad) = texts.iter().find(|t| exact(t).is_none()) {
        // Not a rational number, so only the f64 entry can be asked.
        return Err(variation::roots(&[1.0, special(bad)]).expect_err("not finite"));
    }
    Ok(texts.iter().map(|t| number(t)).collect())
}

fn coefficients(case: &Case<'_>) -> Result<Vec<BigRational>, Error> {
    finite(&list(case.get("coefficients").expect("coefficients")))
}

/// The interval, kept exactly; one that is empty is refused in the crate's words.
fn interval(case: &Case<'_>) -> Result<[BigRational; 2], Error> {
    let Some(ends) = case.get("interval").map(list) else {
        return Ok([number("0"), number("1")]);
    };
    let ends: [BigRational; 2] = finite(&ends)?.try_into().expect("two ends");
    if ends[0] >= ends[1] {
        Interval::try_new(to_f64(&ends[0]), to_f64(&ends[1]))?;
    }
    Ok(ends)
}

fn to_unit(t: &BigRational, [a, b]: &[BigRational; 2]) -> BigRational {
    (t - a) / (b - a)
}

/// The nearest `f64`, or nearly so; exact for dyadic numbers of 53 bits.
fn to_f64(value: &BigRational) -> f64 {
    let shift = 1100;
    let scaled: BigInt = (value.numer() << shift) / value.denom();
    let negative = scaled < BigInt::ZERO;
    let bits = scaled.bits();
    let kept = bits.min(64);
    let top = (scaled.magnitude() >> (bits - kept))
        .iter_u64_digits()
        .next()
        .unwrap_or(0) as f64;
    let exponent = bits as i64 - kept as i64 - shift;
    let half = (exponent / 2) as i32;
    let magnitude = top * 2.0_f64.powi(half) * 2.0_f64.powi(exponent as i32 - half);
    if negative { -magnitude } else { magnitude }
}

/// All numbers as `f64`, if each is one.
fn dyadic(values: &[BigRational]) -> Option<Vec<f64>> {
    values
        .iter()
        .map(|v| Some(to_f64(v)).filter(|x| x.is_finite() && binary(*x) == *v))
        .collect()
}

fn same(case: &Case<'_>, key: &str, got: &[BigRational]) {
    case.seen(key);
    let want: Vec<BigRational> = list(&case.expected()[key])
        .into_iter()
        .map(number)
        .collect();
    case.require(
        case.error().is_none() && got == want,
        &format!("{key}: {got:?} where {want:?} is expected"),
    );
}

fn zeta(case: &Case<'_>) -> Result<BigRational, Error> {
    Ok(finite(&[text(case.get("zeta").expect("zeta"))])?.remove(0))
}

/// The index at `key`; a negative one is beyond every list.
fn index(case: &Case<'_>, key: &str) -> usize {
    let value = case.get(key).and_then(Value::as_i64).expect("an index");
    usize::try_from(value).unwrap_or(usize::MAX)
}

fn polar(case: &Case<'_>) -> Result<(), Error> {
    let (p, interval) = (coefficients(case)?, interval(case)?);
    let pole = to_unit(&zeta(case)?, &interval);
    let answer = polar_derivative(&p, &pole)?;
    same(case, "coefficients", &answer);
    // In f64 the values agree up to rounding.
    let largest = p.iter().map(|x| to_f64(x).abs()).fold(0.0, f64::max);
    let u = to_f64(&pole);
    let floats = polar_derivative(&p.iter().map(to_f64).collect::<Vec<_>>(), &u)?;
    let tolerance = 1e-13 * largest * ((1.0 - u).abs() + u.abs()).max(1.0);
    case.require(
        floats
            .iter()
            .zip(&answer)
            .all(|(x, y)| (x - to_f64(y)).abs() <= tolerance),
        "f64 differs from the exact polar derivative",
    );
    Ok(())
}

fn blossom_value(case: &Case<'_>) -> Result<(), Error> {
    let (p, interval) = (coefficients(case)?, interval(case)?);
    let arguments: Vec<BigRational> = finite(&list(case.get("args").expect("args")))?;
    let arguments: Vec<BigRational> = arguments.iter().map(|t| to_unit(t, &interval)).collect();
    let value = blossom(&p, &arguments)?;
    case.seen("value");
    case.require(
        value == number(text(&case.expected()["value"])),
        &format!("value is {value}"),
    );
    Ok(())
}

fn signs(case: &Case<'_>) -> Result<(), Error> {
    let sequence: Vec<i64> = case
        .get("sequence")
        .and_then(Value::as_array)
        .expect("sequence")
        .iter()
        .map(|v| v.as_i64().expect("integer"))
        .collect();
    case.compare("S", sign_changes(&sequence));
    case.compare("S_L", sign_changes_left(&sequence));
    case.compare("S_R", sign_changes_right(&sequence));
    case.compare("drop_zeros", descartes_changes(&sequence));
    case.compare("S_par", sign_changes_by_parity(&sequence));
    Ok(())
}

fn root_count(coefficients: &[BigRational]) -> Result<usize, Error> {
    Ok(ExactPolynomial::try_new(coefficients.to_vec())?.root_count())
}

fn compare_split(
    case: &Case<'_>,
    lhs: usize,
    bound: &variation::SplitBound<BigRational>,
) -> Result<(), Error> {
    let inner = root_count(&bound.middle)?;
    case.compare("lhs", lhs);
    case.compare("left", bound.left);
    case.compare("inner", inner);
    case.compare("right", bound.right);
    case.compare("bound", bound.total(inner));
    Ok(())
}

fn inequality(case: &Case<'_>) -> Result<(), Error> {
    let (p, interval) = (coefficients(case)?, interval(case)?);
    let bound = pole_bound(&p, &to_unit(&zeta(case)?, &interval))?;
    compare_split(case, root_count(&p)?, &bound)
}

fn corollary(case: &Case<'_>) -> Result<(), Error> {
    let p = coefficients(case)?;
    interval(case)?;
    let bound = corollary_bound(&p, index(case, "k"), index(case, "l"))?;
    compare_split(case, root_count(&p)?, &bound)
}

fn subpolynomials(case: &Case<'_>) -> Result<(), Error> {
    let p = coefficients(case)?;
    let whole = root_count(&p)?;
    // The middle terms of the corollary are the parts of the list.
    let first = corollary_bound(&p, 0, index(case, "split"))?.middle;
    let second = corollary_bound(&p, index(case, "split"), p.len() - 1)?.middle;
    case.compare("Z", whole);
    case.compare("Z_first", root_count(&first)?);
    case.compare("Z_second", root_count(&second)?);
    Ok(())
}

fn chain(case: &Case<'_>) -> Result<(), Error> {
    let (p, interval) = (coefficients(case)?, interval(case)?);
    let poles: Vec<BigRational> = finite(&list(case.get("zetas").expect("zetas")))?;
    let poles: Vec<BigRational> = poles.iter().map(|t| to_unit(t, &interval)).collect();
    let bound = chain_bound(&p, &poles)?;
    same(case, "polygon", &bound.polygon);
    case.compare("S", bound.printed);
    case.compare("S_par", sign_changes_by_parity(&bound.polygon));
    case.compare("drop_zeros_count", descartes_changes(&bound.polygon));
    case.compare("S_control_polygon", sign_changes(&p));
    let of_polygon = lowered_by_parity(&p, sign_changes_by_parity(&bound.polygon));
    case.compare("best_bound", of_polygon);
    let count = root_count(&p)?;
    case.compare("Z", count);
    // The crate takes the control polygon's own count where that is smaller, which the file does not.
    case.require(
        (count..=of_polygon).contains(&bound.best),
        "the best bound lies outside [Z, the bound of the polygon]",
    );
    if let (Some(p), Some(poles)) = (dyadic(&p), dyadic(&poles)) {
        let floats = chain_bound(&p, &poles)?;
        case.compare("S", floats.printed);
        case.require(floats.best == bound.best, "another best bound in f64");
    }
    Ok(())
}

/// A bound after the rule of parity: known only where neither end is a root.
fn lowered_by_parity(coefficients: &[BigRational], bound: usize) -> usize {
    let zero = number("0");
    let (first, last) = (&coefficients[0], &coefficients[coefficients.len() - 1]);
    if *first == zero || *last == zero {
        return bound;
    }
    let odd = (*first < zero) != (*last < zero);
    bound - usize::from(bound > 0 && (bound % 2 == 1) != odd)
}

/// Compares enclosures in `t` with the listed roots.
fn compare_roots(
    case: &Case<'_>,
    listed: &[Value],
    key: &str,
    roots: &[ExactRoot],
    [a, b]: &[BigRational; 2],
) {
    if roots.len() != listed.len() {
        case.fail(format!(
            "{} roots where {} are expected",
            roots.len(),
            listed.len()
        ));
        return;
    }
    let width = b - a;
    let tolerance = number(ROOT_TOLERANCE) * &width;
    let rounding = number(VALUE_ROUNDING);
    for (root, want) in roots.iter().zip(listed) {
        let (lo, hi) = (a + &root.lo * &width, a + &root.hi * &width);
        let value = number(text(&want[key]));
        case.require(
            &lo - &rounding <= value && value <= &hi + &rounding,
            &format!("{value} lies outside its enclosure"),
        );
        case.require(
            &hi - &lo <= tolerance,
            &format!("the enclosure of {value} is wider than the tolerance"),
        );
        let exact_key = if key == "t" { "t_exact" } else { "exact" };
        if let Some(exact) = want.get(exact_key) {
            let exact = number(text(exact));
            case.require(
                lo <= exact && exact <= hi,
                &format!("{exact} lies outside its enclosure"),
            );
        }
        case.require(
            want["multiplicity"].as_u64() == Some(u64::from(root.multiplicity)),
            &format!("{value} has multiplicity {}", root.multiplicity),
        );
    }
}

/// Enclosures that the `f64` entry gives, as exact numbers.
fn exactly(roots: &[Root]) -> Vec<ExactRoot> {
    roots
        .iter()
        .map(|root| ExactRoot {
            lo: binary(root.lo),
            hi: binary(root.hi),
            multiplicity: root.multiplicity().unwrap_or(0),
        })
        .collect()
}

/// The exact value of an `f64`.
fn binary(x: f64) -> BigRational {
    let bits = x.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i64;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (mantissa, exponent) = if biased == 0 {
        (fraction, -1074)
    } else {
        (fraction | 1 << 52, biased - 1075)
    };
    let mantissa = BigInt::from(if x < 0.0 { -mantissa } else { mantissa });
    if exponent < 0 {
        BigRational::new(mantissa, BigInt::from(1) << (-exponent))
    } else {
        BigRational::from(mantissa << exponent)
    }
}

fn isolate(case: &Case<'_>) -> Result<(), Error> {
    let interval = interval(case)?;
    let p = coefficients(case)?;
    let roots = ExactPolynomial::try_new(p.clone())?.roots(1e-12)?;
    let listed = case.expected()["roots"]
        .as_array()
        .cloned()
        .unwrap_or_default();
    case.seen("roots");
    case.compare("distinct", roots.len());
    case.compare(
        "count_with_multiplicity",
        roots.iter().map(|root| root.multiplicity).sum::<u32>(),
    );
    compare_roots(case, &listed, "value", &roots, &interval);
    if let (Some(p), Some(ends)) = (dyadic(&p), dyadic(&interval)) {
        // The f64 entry, on [0, 1]: the ends are mapped exactly by `compare_roots`.
        compare_roots(
            case,
            &listed,
            "value",
            &exactly(&variation::roots(&p)?),
            &interval,
        );
        let mapped = roots_on(&p, Interval::try_new(ends[0], ends[1])?)?;
        case.compare("distinct", mapped.len());
    }
    Ok(())
}

fn generator(case: &Case<'_>) -> Result<(), Error> {
    let set = text(case.get("set").expect("set"));
    let set = set
        .chars()
        .next()
        .and_then(Set::from_letter)
        .unwrap_or_else(|| panic!("unknown set {set}"));
    let degree = case.get("degree").and_then(Value::as_u64).expect("degree") as usize;
    let index = case.get("index").and_then(Value::as_u64).expect("index");
    let exact: Vec<BigRational> = set
        .polynomial(degree, index)
        .into_iter()
        .map(binary)
        .collect();
    same(case, "coefficients", &exact);
    Ok(())
}

fn curve(case: &Case<'_>) -> Result<(Vec<[BigRational; 2]>, Vec<BigRational>), Error> {
    let points: Vec<[BigRational; 2]> = case
        .get("points")
        .and_then(Value::as_array)
        .expect("points")
        .iter()
        .map(|p| Ok(finite(&list(p))?.try_into().expect("two coordinates")))
        .collect::<Result<_, Error>>()?;
    let weights = match case.get("weights") {
        Some(weights) => finite(&list(weights))?,
        None => vec![number("1"); points.len()],
    };
    Ok((points, weights))
}

/// What lines and implicit curves have in common: the polynomial, its sign changes and the hits.
fn compare_hits(
    case: &Case<'_>,
    curve: &ExactCurve,
    polynomial: &ExactPolynomial,
) -> Result<(), Error> {
    let roots = polynomial.roots(1e-12).map_err(|error| match error {
        Error::IdenticallyZero => Error::LiesOn,
        other => other,
    })?;
    same(case, "coefficients", polynomial.coefficients());
    case.compare("S_of_polygon", sign_changes(polynomial.coefficients()));
    case.compare(
        "count_with_multiplicity",
        roots.iter().map(|root| root.multiplicity).sum::<u32>(),
    );
    let listed = case.expected()["hits"]
        .as_array()
        .cloned()
        .unwrap_or_default();
    case.seen("hits");
    compare_roots(case, &listed, "t", &roots, &[number("0"), number("1")]);
    // The curve may run fast: its points are taken at sharper parameters than those that are compared.
    for (root, want) in polynomial
        .roots(POINT_PARAMETER_TOLERANCE)?
        .iter()
        .zip(&listed)
    {
        let t = (&root.lo + &root.hi) / BigInt::from(2);
        compare_point(case, want, &curve.point(&t));
    }
    Ok(())
}

fn compare_point(case: &Case<'_>, want: &Value, [x, y]: &[BigRational; 2]) {
    let want = [&want["x"], &want["y"]].map(|v| number(text(v)));
    let zero = number("0");
    let magnitude = |v: &BigRational| if *v < zero { -v } else { v.clone() };
    let scale = magnitude(&want[0])
        .max(magnitude(&want[1]))
        .max(number("1"));
    let tolerance = number(POINT_TOLERANCE) * scale;
    let near = magnitude(&(x - &want[0])) <= tolerance && magnitude(&(y - &want[1])) <= tolerance;
    case.require(
        near,
        &format!("the hit is at ({}, {})", to_f64(x), to_f64(y)),
    );
}

/// The same question to the `f64` entry, if every number of the case is dyadic.
fn float_points(
    points: &[[BigRational; 2]],
    weights: &[BigRational],
) -> Option<(Vec<glam::DVec2>, Vec<f64>)> {
    let points = points
        .iter()
        .map(|p| dyadic(p).map(|p| glam::DVec2::new(p[0], p[1])))
        .collect::<Option<Vec<_>>>()?;
    Some((points, dyadic(weights)?))
}

fn compare_float_hits(case: &Case<'_>, hits: &[variation::Hit]) {
    let listed = case.expected()["hits"]
        .as_array()
        .cloned()
        .unwrap_or_default();
    let roots: Vec<Root> = hits.iter().map(|hit| hit.root).collect();
    compare_roots(
        case,
        &listed,
        "t",
        &exactly(&roots),
        &[number("0"), number("1")],
    );
    for (hit, want) in hits.iter().zip(&listed) {
        compare_point(case, want, &[binary(hit.point.x), binary(hit.point.y)]);
    }
}

fn line(case: &Case<'_>) -> Result<(), Error> {
    let (points, weights) = curve(case)?;
    let numbers: [BigRational; 3] = finite(&list(case.get("line").expect("line")))?
        .try_into()
        .expect("three coefficients");
    let exact_curve = ExactCurve::try_new(points.clone(), weights.clone())?;
    let polynomial = exact_curve.line_polynomial(&numbers)?;
    compare_hits(case, &exact_curve, &polynomial)?;
    if let (Some((points, weights)), Some(line)) =
        (float_points(&points, &weights), dyadic(&numbers))
    {
        let curve = Curve::rational(&points, &weights)?;
        let line = Line::try_new(line[0], line[1], line[2])?;
        compare_float_hits(case, &curve.meet_line(line)?);
    }
    Ok(())
}

fn implicit(case: &Case<'_>) -> Result<(), Error> {
    let (points, weights) = curve(case)?;
    let terms: Vec<(usize, usize, BigRational)> = case
        .get("terms")
        .and_then(Value::as_array)
        .expect("terms")
        .iter()
        .map(|t| {
            let power = |k: usize| t[k].as_u64().expect("power") as usize;
            Ok((power(0), power(1), finite(&[text(&t[2])])?.remove(0)))
        })
        .collect::<Result<_, Error>>()?;
    let exact_curve = ExactCurve::try_new(points.clone(), weights.clone())?;
    let polynomial = exact_curve.implicit_polynomial(&terms)?;
    compare_hits(case, &exact_curve, &polynomial)?;
    let factors: Vec<BigRational> = terms.iter().map(|t| t.2.clone()).collect();
    if let (Some((points, weights)), Some(factors)) =
        (float_points(&points, &weights), dyadic(&factors))
    {
        let terms = terms
            .iter()
            .zip(factors)
            .map(|((i, j, _), coefficient)| Term {
                x_power: *i as u32,
                y_power: *j as u32,
                coefficient,
            });
        let implicit = ImplicitCurve::try_new(terms.collect())?;
        compare_float_hits(
            case,
            &Curve::rational(&points, &weights)?.meet_implicit(&implicit)?,
        );
    }
    Ok(())
}
