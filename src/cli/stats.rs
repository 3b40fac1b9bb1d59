//! What `check --stats` prints.

use serde_json::json;
use texcrd::diagnostic::{SourceMap, Span};
use texcrd::isa::ShaderKind;
use texcrd::validate::{Statistics, Usage};

/// The statistics for people.
pub(super) fn to_text(sources: &SourceMap, statistics: &Statistics) -> String {
    let of = |usage: Usage| format!("{} of {}", usage.used, usage.allowed);
    let list = |numbers: &[u32]| -> String {
        let numbers: Vec<_> = numbers.iter().map(u32::to_string).collect();
        numbers.join(", ")
    };
    let mut text = format!("{}\n", statistics.version);
    for (i, phase) in statistics.phases.iter().enumerate() {
        let label = match (statistics.version.kind(), statistics.phases.len()) {
            (ShaderKind::Pixel, 2..) => format!("phase {}", i + 1),
            _ => "slots".to_string(),
        };
        let amount = match statistics.version.kind() {
            ShaderKind::Vertex => of(phase.arithmetic),
            ShaderKind::Pixel => format!(
                "{} texture, {} arithmetic",
                of(phase.texture),
                of(phase.arithmetic)
            ),
        };
        text.push_str(&format!("  {label:<13} {amount}\n"));
    }
    for usage in statistics.files.iter().filter(|f| !f.numbers.is_empty()) {
        let names: Vec<_> = (usage.numbers.iter())
            .map(|n| usage.file.register_name(*n))
            .collect();
        let prefix = usage.file.row().prefix;
        text.push_str(&format!(
            "  {:<13} {} of {}: {}\n",
            format!("{prefix}#"),
            names.len(),
            usage.allowed,
            names.join(" ")
        ));
    }
    if statistics.relative {
        text.push_str("  c[a0.x + n]   any constant may be read\n");
    }
    let mut add = |label: &str, what: String| text.push_str(&format!("  {label:<13} {what}\n"));
    for stage in &statistics.stages {
        let textures = stage.coordinates.textures();
        let places = lines(sources, &stage.samples);
        add(
            &format!("stage {}", stage.stage),
            format!("{textures}, {}", listed(&places)),
        );
    }
    if !statistics.coordinate_sets.is_empty() {
        add("coordinates", list(&statistics.coordinate_sets));
    }
    for full in &statistics.full_ports {
        let prefix = full.file.row().prefix;
        let places = listed(&lines(sources, &full.places));
        let by = if full.pairs { "in pairs, " } else { "" };
        add(
            "ports full",
            format!("{0} of {0} {prefix}# at once: {by}{places}", full.allowed),
        );
    }
    for pair in &statistics.possible_pairs {
        let places = lines(sources, &[pair.first, pair.second]);
        let plural = if pair.saves == 1 { "" } else { "s" };
        add(
            "could pair",
            format!("{}, for {} slot{plural} less", listed(&places), pair.saves),
        );
    }
    text
}

/// The lines of the first words of these places, each once.
fn lines(sources: &SourceMap, places: &[Span]) -> Vec<usize> {
    let line = |place: &Span| sources.locate(*place).map(|at| at.line);
    let mut lines: Vec<usize> = places.iter().filter_map(line).collect();
    lines.dedup();
    lines
}

/// `line 3`, `lines 3, 5 and 7`.
fn listed(lines: &[usize]) -> String {
    let mut words: Vec<String> = lines.iter().map(usize::to_string).collect();
    match words.pop() {
        None => "no line".to_string(),
        Some(last) if words.is_empty() => format!("line {last}"),
        Some(last) => format!("lines {} and {last}", words.join(", ")),
    }
}

/// The statistics for programs; lines are those of the file that was given.
pub(super) fn to_json(sources: &SourceMap, statistics: &Statistics) -> serde_json::Value {
    let of = |usage: Usage| json!({ "used": usage.used, "allowed": usage.allowed });
    let phases: Vec<_> = (statistics.phases.iter())
        .map(|p| json!({ "arithmetic": of(p.arithmetic), "texture": of(p.texture) }))
        .collect();
    let files: serde_json::Map<_, _> = (statistics.files.iter())
        .map(|f| {
            let usage = json!({ "used": f.numbers, "allowed": f.allowed });
            (f.file.row().prefix.to_string(), usage)
        })
        .collect();
    let stages: Vec<_> = (statistics.stages.iter())
        .map(|s| {
            let textures = s.coordinates.textures();
            let lines = lines(sources, &s.samples);
            json!({ "stage": s.stage, "textures": textures, "lines": lines })
        })
        .collect();
    let full_ports: Vec<_> = (statistics.full_ports.iter())
        .map(|f| {
            let lines = lines(sources, &f.places);
            let file = f.file.row().prefix;
            json!({ "file": file, "allowed": f.allowed, "pairs": f.pairs, "lines": lines })
        })
        .collect();
    let possible_pairs: Vec<_> = (statistics.possible_pairs.iter())
        .map(|p| json!({ "lines": lines(sources, &[p.first, p.second]), "saves": p.saves }))
        .collect();
    json!({
        "version": statistics.version.name(),
        "phases": phases,
        "registers": files,
        "relative": statistics.relative,
        "stages": stages,
        "coordinate_sets": statistics.coordinate_sets,
        "full_ports": full_ports,
        "possible_pairs": possible_pairs,
    })
}
