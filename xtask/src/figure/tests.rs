//! The figure as a whole, against what must be on the page.

use super::*;
use crate::color::{BLUE, GREY, INK, VERMILION};

fn example() -> Figure {
    let mut drawing = Plot::geometry("all items");
    drawing.circle(DVec2::ZERO, 1.0, BLUE.line().label("circle"));
    drawing.polygon(
        &[DVec2::ZERO, DVec2::X, DVec2::Y],
        VERMILION.fill().label("region"),
    );
    drawing.arrow(
        DVec2::ZERO,
        DVec2::new(-0.7, 0.7),
        INK.line().label("vector"),
    );
    drawing.segment(
        DVec2::new(-1.0, 0.0),
        DVec2::new(1.0, 0.0),
        GREY.line().dashed().label("dashed"),
    );
    drawing.points(
        &[DVec2::X, DVec2::Y],
        Marker::Ring,
        BLUE.line().label("points"),
    );
    drawing.point(DVec2::NEG_X, "P₀", Side::BelowLeft, INK.fill());
    let mut chart = Plot::chart("convergence", "steps", "error");
    chart.log_x().log_y();
    let errors: Vec<DVec2> = (0..8)
        .map(|i| DVec2::new(f64::from(1 << i), 0.1_f64.powi(i + 1)))
        .collect();
    chart.polyline(&errors, BLUE.line().label("measured"));
    chart.points(&errors, Marker::Disc, BLUE.fill());
    Figure::grid(2, vec![drawing, chart]).title("A figure & its parts")
}

#[test]
fn a_circle_is_where_the_fit_puts_it() {
    let mut plot = Plot::geometry("");
    plot.view(DVec2::splat(-1.0), DVec2::splat(1.0));
    plot.circle(DVec2::ZERO, 0.5, BLUE.fill());
    let figure = Figure::new(plot).aspect(1.0);
    let image = figure.image(640);
    // The plot is 616 points wide from 12 on; the circle reaches from a quarter to three quarters of it.
    let blue = |x, y| image.pixel(x, y).is_some_and(|p| p[0] < 10 && p[2] > 160);
    assert!(blue(320, 320));
    assert!(blue(168, 320) && !blue(164, 320));
    assert!(blue(320, 472) && !blue(320, 476));
    assert_eq!(image.pixel(5, 5), Some([255, 255, 255, 255]));
}

#[test]
fn page_and_pixels_agree() {
    let figure = example();
    let image = figure.image(1280);
    assert_eq!(image.width(), 1280);
    assert_eq!(f64::from(image.height()), (2.0 * figure.page().y).ceil());
}

#[test]
fn svg_says_the_same_as_the_picture() {
    let svg = example().svg("circle & region");
    for words in [
        "A figure &amp; its parts",
        "convergence",
        "10⁻⁴",
        "P₀",
        "dashed",
    ] {
        assert!(svg.contains(&format!("aria-label=\"{words}\"")), "{words}");
    }
    assert!(svg.contains("<title>circle &amp; region</title>"));
    assert!(svg.contains(&BLUE.css()) && svg.contains("stroke-dasharray"));
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn figures_do_not_depend_on_the_run() {
    assert_eq!(example().image(320), example().image(320));
    assert_eq!(example().svg("a"), example().svg("a"));
}

#[test]
fn empty_constant_and_wild_plots_are_drawn() {
    let mut constant = Plot::chart("constant", "x", "y");
    constant.graph(|_| 2.0, 0.0, 1.0, BLUE.line());
    let mut wild = Plot::geometry("wild");
    wild.view(DVec2::splat(-1.0), DVec2::splat(1.0));
    wild.trace(|t| DVec2::new(t, 1.0 / t), -1.0, 1.0, BLUE.line());
    wild.segment(DVec2::splat(-1e300), DVec2::splat(1e300), BLUE.line());
    wild.points(&[DVec2::NAN, DVec2::INFINITY], Marker::Cross, BLUE.line());
    wild.arrow(DVec2::ZERO, DVec2::ZERO, BLUE.line());
    let mut negative = Plot::chart("log of a negative", "x", "y");
    negative.log_y().polyline(
        &[
            DVec2::new(0.0, -1.0),
            DVec2::new(1.0, 10.0),
            DVec2::new(2.0, 100.0),
        ],
        BLUE.line(),
    );
    let plots = vec![Plot::geometry("empty"), constant, wild, negative];
    let figure = Figure::grid(2, plots);
    assert!(!figure.svg("").contains("NaN"));
    assert_eq!(figure.image(320).width(), 320);
}
