//! A result as text: its rows as an aligned table, its other members a line each.

use serde_json::Value;

use crate::report::plain;

/// The text of a bench's result.
pub(super) fn text(result: &Value) -> String {
    let Value::Object(members) = result else {
        return plain(result);
    };
    let mut lines: Vec<String> = Vec::new();
    for (key, value) in members {
        match value {
            Value::Array(rows) if rows.iter().all(Value::is_object) => lines.extend(table(rows)),
            value => lines.push(format!("{key}: {}", plain(value))),
        }
    }
    lines.join("\n")
}

/// Nested objects become columns `outer.inner`.
fn cells(row: &Value, prefix: &str, out: &mut Vec<(String, String)>) {
    if let Value::Object(members) = row {
        for (key, value) in members {
            let key = format!("{prefix}{key}");
            if value.is_object() {
                cells(value, &format!("{key}."), out);
            } else {
                out.push((key, plain(value)));
            }
        }
    }
}

fn table(rows: &[Value]) -> Vec<String> {
    let mut columns: Vec<String> = Vec::new();
    let mut lines: Vec<Vec<(String, String)>> = Vec::new();
    for row in rows {
        let mut line = Vec::new();
        cells(row, "", &mut line);
        for (key, _) in &line {
            if !columns.contains(key) {
                columns.push(key.clone());
            }
        }
        lines.push(line);
    }
    let find = |line: &[(String, String)], column: &str| {
        line.iter()
            .find(|(key, _)| key == column)
            .map_or(String::new(), |(_, text)| text.clone())
    };
    let mut body: Vec<Vec<String>> = vec![columns.clone()];
    body.extend(
        lines
            .iter()
            .map(|line| columns.iter().map(|c| find(line, c)).collect()),
    );
    let width = |column: usize| {
        body.iter()
            .map(|l| l[column].chars().count())
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns.len()).map(width).collect();
    body.iter()
        .map(|line| {
            let cells = line
                .iter()
                .zip(&widths)
                .map(|(text, &w)| format!("{text:>w$}"));
            cells.collect::<Vec<_>>().join("  ")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn rows_align_and_nested_members_become_columns() {
        let result = json!({"n": 3, "rows": [{"a": 1, "p": {"ns": 2.5}}, {"a": 100}]});
        assert_eq!(text(&result), "n: 3\n  a  p.ns\n  1   2.5\n100      ");
    }
}
