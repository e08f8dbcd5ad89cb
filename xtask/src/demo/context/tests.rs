use super::*;
use anyhow::bail;

fn settings(name: &str) -> Settings {
    let out = std::env::temp_dir().join(format!("xtask-context-{name}-{}", std::process::id()));
    Settings {
        out,
        width: None,
        height: None,
        samples: None,
        seed: 1,
        quick: true,
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_failing_writer_leaves_nothing_behind() {
    let settings = settings("failing");
    let out = settings.out.clone();
    let mut context = Context::open("d", "p", settings).unwrap();
    context.text("whole.txt", "old").unwrap();
    let failed = context.file("whole.txt", |file| {
        file.write_all(b"half")?;
        bail!("no more")
    });
    assert!(failed.is_err());
    assert_eq!(fs::read_to_string(out.join("d/whole.txt")).unwrap(), "old");
    assert_eq!(names(&out.join("d")), ["whole.txt"]);
    assert!(context.text("../outside.txt", "").is_err());
    assert!(context.text("", "").is_err());
    fs::remove_dir_all(out).unwrap();
}

#[test]
fn the_report_comes_last_and_an_old_one_goes_first() {
    let settings = settings("report");
    let out = settings.out.clone();
    let mut context = Context::open("d", "p, Fig. 1", settings.clone()).unwrap();
    context.number("gap", f64::NAN, Target::AtMost(1.0));
    context.number("gap", 0.5, Target::AtMost(1.0));
    context.number("free", vec![1, 2], Target::Free);
    context.text("a.txt", "a").unwrap();
    let report = context.close().unwrap();
    assert_eq!(report.missed().count(), 0);
    let text = fs::read_to_string(out.join("d/report.json")).unwrap();
    let value: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value["demo"], "d");
    assert_eq!(value["numbers"]["gap"], 0.5);
    assert_eq!(value["targets"]["gap"]["met"], true);
    assert_eq!(value["files"], serde_json::json!(["a.txt"]));
    drop(Context::open("d", "p", settings).unwrap());
    assert_eq!(names(&out.join("d")), ["a.txt"]);
    fs::remove_dir_all(out).unwrap();
}
