//! What was found, for programs.

use super::{
    CHANNELS, Compared, Findings, FragmentComparison, LineComparison, Pixel, register_name,
};
use crate::cli::eval::{json_number, json_vector};
use serde_json::{Map, Value, json};
use texcrd::gpu::{Differences, Pair, Parting};
use texcrd::program::Program;

pub(super) fn report(findings: &Findings<'_>) -> Value {
    let arguments = findings.arguments;
    let [width, height] = findings.size;
    let tolerance = arguments.tolerance;
    let targets = (findings.targets.iter())
        .map(|face| {
            let [inside, on_edges] = of_places(&face.compared, tolerance);
            json!({
                "target": face.target,
                "face": face.face,
                "inside": inside,
                "on_edges": on_edges,
            })
        })
        .collect();
    let [inside, on_edges] = of_places(&findings.picture, tolerance);
    let mut report = of_pixels(&findings.all, tolerance);
    let head = [
        ("scene", json!(arguments.scene)),
        ("adapter", json!(findings.adapter)),
        ("size", json!([width, height])),
        ("tolerance", json!(tolerance)),
        ("strict", json!(arguments.strict)),
        ("level_error", json_number(arguments.level_error)),
        ("passed", json!(findings.passed())),
        ("inside", inside),
        ("on_edges", on_edges),
        ("targets", Value::Array(targets)),
        (
            "pixel",
            (findings.pixel.as_ref()).map_or(Value::Null, |pixel| one_pixel(findings, pixel)),
        ),
    ];
    report.extend(head.map(|(key, value)| (key.to_string(), value)));
    Value::Object(report)
}

/// The numbers of the pixels inside triangles and of those on edges, with those that levels of detail do not explain.
fn of_places(compared: &Compared, tolerance: u8) -> [Value; 2] {
    let [inside, edges] = compared.judged();
    [(&compared.inside, inside), (&compared.edges, edges)].map(|(all, judged)| {
        let mut object = of_pixels(all, tolerance);
        object.insert("beyond_levels".into(), json!(judged.above(tolerance)));
        Value::Object(object)
    })
}

/// The numbers of some of the pixels.
fn of_pixels(differences: &Differences, tolerance: u8) -> Map<String, Value> {
    let channels: Map<_, _> = (CHANNELS.iter())
        .zip(differences.max_of_channel)
        .zip(differences.mean_of_channel())
        .map(|((name, max), mean)| (name.to_string(), json!({ "max": max, "mean": mean })))
        .collect();
    let histogram: Vec<_> = (differences.counts())
        .map(|(step, count)| json!({ "difference": step, "pixels": count }))
        .collect();
    let worst = differences
        .worst
        .map(|worst| json!({ "x": worst.x, "y": worst.y, "cpu": worst.cpu, "gpu": worst.gpu }));
    let object = [
        ("pixels", json!(differences.pixels())),
        ("above_tolerance", json!(differences.above(tolerance))),
        ("max", json!(differences.max())),
        ("channels", Value::Object(channels)),
        ("histogram", json!(histogram)),
        ("worst", json!(worst)),
    ];
    object
        .map(|(key, value)| (key.to_string(), value))
        .into_iter()
        .collect()
}

fn one_pixel(findings: &Findings<'_>, pixel: &Pixel) -> Value {
    let comparison = match &pixel.comparison {
        Ok(comparison) => comparison,
        Err(error) => return json!({ "error": error.to_string() }),
    };
    let draws = findings.draws();
    let name = |draw: usize| draws.get(draw).map(|draw| draw.name);
    let covered_by: Vec<Value> = (comparison.history.events.iter())
        .map(|event| {
            json!({
                "draw": name(event.draw),
                "primitive": event.fragment.primitive,
                "fate": event.merge.fate().name(),
                "after": event.merge.after.color,
            })
        })
        .collect();
    let fragments: Vec<Value> = (comparison.fragments.iter())
        .filter_map(|fragment| {
            let draw = draws.get(fragment.event.draw)?;
            let mut object = one_fragment(findings, &draw.pixel.program, fragment);
            object["draw"] = json!(draw.name);
            Some(object)
        })
        .collect();
    json!({
        "x": comparison.pixel[0],
        "y": comparison.pixel[1],
        "inside": pixel.inside,
        "cpu": pixel.cpu,
        "gpu": pixel.gpu,
        "part_tolerance": json_number(findings.arguments.part_tolerance),
        "covered_by": covered_by,
        "compared": fragments,
    })
}

fn one_fragment(
    findings: &Findings<'_>,
    program: &Program,
    fragment: &FragmentComparison,
) -> Value {
    let pairs =
        |pairs: &[Pair]| -> Value { pairs.iter().map(|pair| one_pair(program, pair)).collect() };
    let (file, _) = findings.place(program.version_span);
    let line = |line: &LineComparison| {
        let samples: Vec<Value> = (line.samples.iter())
            .map(|texture| {
                json!({
                    "stage": texture.stage,
                    "texture": texture.name,
                })
            })
            .collect();
        json!({
            "line": findings.place(line.span).1,
            "text": findings.instruction(line),
            "reads": pairs(&line.reads),
            "writes": pairs(&line.writes),
            "samples": samples,
            "kills": line.kills.map(|[cpu, gpu]| json!({ "cpu": cpu, "gpu": gpu })),
            "relative_difference": json_number(line.relative_difference()),
        })
    };
    let parting = match fragment.parting(findings.arguments.part_tolerance) {
        Parting::Nowhere => Value::Null,
        Parting::Inputs => json!({ "at": "inputs" }),
        Parting::Line(first) => {
            let mut object = line(first);
            object["at"] = json!("line");
            object
        }
    };
    let lines: Vec<Value> = fragment.lines.iter().map(line).collect();
    json!({
        "primitive": fragment.event.fragment.primitive,
        "shader": file,
        "covered_on_gpu": fragment.covered,
        "killed": { "cpu": fragment.killed[0], "gpu": fragment.killed[1] },
        "inputs": pairs(&fragment.inputs),
        "registers": pairs(&fragment.registers()),
        "parting": parting,
        "explanation": fragment.explanation(findings.arguments.part_tolerance).map(line),
        "lines": lines,
    })
}

fn one_pair(program: &Program, pair: &Pair) -> Value {
    json!({
        "register": register_name(program, pair.slot),
        "components": pair.mask.components().map(|c| program.letters()[c]).collect::<String>(),
        "cpu": json_vector(pair.cpu),
        "gpu": json_vector(pair.gpu),
        "difference": json_number(pair.difference()),
        "relative_difference": json_number(pair.relative_difference()),
    })
}
