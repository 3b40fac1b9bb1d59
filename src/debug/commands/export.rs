//! `export`: every moment of every run, as JSON, CSV or Markdown.

use super::{Arguments, Console, Effect, Fault, Outcome, Reply, merge, table, tell};
use crate::debug::expression::number_text;
use crate::debug::moment::{Change, Event, Moment, Sample};
use crate::debug::run::Run;
use crate::debug::session::Session;
use crate::debug::text::{Line, Text};
use crate::isa::WriteMask;
use crate::program::letters;
use crate::texture::{Tap, footprint};

/// A format with the function that writes it.
struct Row {
    name: &'static str,
    write: fn(&[Run<'_>]) -> String,
}

static FORMATS: [Row; 3] = [
    Row {
        name: "json",
        write: json,
    },
    Row {
        name: "csv",
        write: csv,
    },
    Row {
        name: "markdown",
        write: markdown,
    },
];

/// The names of the formats.
pub(super) fn formats() -> impl Iterator<Item = &'static str> {
    FORMATS.iter().map(|row| row.name)
}

/// `export csv run.csv`; without a file the text is the answer.
pub(super) fn export(
    _: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let text = arguments.text;
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    let (name, path) = text.split_at(end);
    let row = format(name)?;
    let written = (row.write)(session.runs());
    let path = path.trim();
    if path.is_empty() {
        let lines = written.lines().map(Line::from).collect();
        return Ok(Text { lines }.into());
    }
    Ok(Reply {
        effect: Some(Effect::Write {
            path: path.to_string(),
            text: written,
        }),
        ..Reply::default()
    })
}

fn format(name: &str) -> Result<&'static Row, Fault> {
    let lower = name.to_ascii_lowercase();
    let lower = if lower == "md" { "markdown" } else { &lower };
    let known = FORMATS.iter().find(|row| row.name == lower);
    known.ok_or_else(|| match name {
        "" => "export as json, csv or markdown".into(),
        _ => table::unknown("format", name, formats()),
    })
}

/// A moment in words, for all formats.
struct Entry<'m> {
    line: Option<usize>,
    text: String,
    register: String,
    components: String,
    change: Option<Change>,
    /// The operands, each with its value.
    reads: Vec<String>,
    sample: Option<&'m Sample>,
    remarks: Vec<String>,
}

fn entry<'m>(run: &Run<'_>, moment: &'m Moment) -> Entry<'m> {
    let kind = run.listing.kind();
    let text = match (moment.instruction, &moment.event) {
        (Some(number), _) => run.listing.text(number),
        (None, Event::Input(_)) => "input".to_string(),
        (None, Event::Set) => "set".to_string(),
        (None, _) => tell::around(moment),
    };
    let mut remarks = tell::remarks(run, moment);
    if let Event::Merge(stage) = &moment.event {
        let lines = merge::lines(stage).lines;
        remarks.extend(lines.iter().map(|line| line.to_string().trim().to_string()));
    }
    let (reads, sample) = match &moment.event {
        Event::Step { reads, sample, .. } => {
            let texts = reads
                .iter()
                .filter_map(|read| tell::read_text(run, read, read.slots));
            (texts.collect(), sample.as_ref())
        }
        _ => (Vec::new(), None),
    };
    let name = |change: Change| tell::target_name(change.target, kind);
    let components = |change: Change| components_text(run, change.mask);
    Entry {
        line: moment.instruction.map(|number| run.listing.line(number)),
        text,
        register: moment.change.map(name).unwrap_or_default(),
        components: moment.change.map(components).unwrap_or_default(),
        change: moment.change,
        reads,
        sample,
        remarks,
    }
}

fn components_text(run: &Run<'_>, mask: WriteMask) -> String {
    let letters = letters(run.listing.kind());
    mask.components().map(|c| letters[c]).collect()
}

// --- JSON ---

fn json(runs: &[Run<'_>]) -> String {
    let runs: Vec<String> = runs.iter().map(json_run).collect();
    format!("{{\"runs\": [\n{}\n]}}\n", runs.join(",\n"))
}

fn json_run(run: &Run<'_>) -> String {
    let moments: Vec<String> = run
        .moments
        .iter()
        .map(|moment| json_moment(run, moment))
        .collect();
    format!(
        "  {{\"run\": {}, \"version\": {}, \"moments\": [\n{}\n  ]}}",
        quoted(&tell::run_name(run)),
        quoted(run.listing.program.version.name()),
        moments.join(",\n")
    )
}

fn json_moment(run: &Run<'_>, moment: &Moment) -> String {
    let entry = entry(run, moment);
    let mut members = Vec::new();
    if let Some(line) = entry.line {
        members.push(format!("\"line\": {line}"));
    }
    members.push(format!("\"text\": {}", quoted(&entry.text)));
    if let Some(change) = &entry.change {
        let lane = run.lane & 3;
        members.push(format!("\"register\": {}", quoted(&entry.register)));
        members.push(format!("\"components\": {}", quoted(&entry.components)));
        members.push(format!("\"before\": {}", json_vector(&change.before[lane])));
        members.push(format!("\"after\": {}", json_vector(&change.after[lane])));
    }
    if let Some(change) = entry.change.filter(|change| !change.first.is_empty()) {
        let first = components_text(run, change.first);
        members.push(format!("\"first_write\": {}", quoted(&first)));
    }
    let reads: Vec<String> = entry.reads.iter().map(|read| quoted(read)).collect();
    if !reads.is_empty() {
        members.push(format!("\"reads\": [{}]", reads.join(", ")));
    }
    if let Some(sample) = entry.sample {
        members.push(format!("\"sample\": {}", json_sample(run, sample)));
    }
    if !entry.remarks.is_empty() {
        let remarks: Vec<String> = entry.remarks.iter().map(|words| quoted(words)).collect();
        members.push(format!("\"remarks\": [{}]", remarks.join(", ")));
    }
    format!("    {{{}}}", members.join(", "))
}

fn json_sample(run: &Run<'_>, sample: &Sample) -> String {
    let lane = run.lane & 3;
    let (coordinates, detail) = (sample.coordinates[lane], sample.detail[lane]);
    let stage = run.environment.stages.get(sample.stage);
    let bound = stage.and_then(|stage| Some((stage.texture?, &stage.sampler)));
    let texels = bound.map_or(Vec::new(), |(texture, sampler)| {
        let taps = footprint(texture, sampler, coordinates, detail).taps;
        let json = |tap: &Tap| {
            let texel = tap
                .texel
                .map_or("null".to_string(), |place| format!("{place:?}"));
            format!(
                "{{\"face\": {}, \"level\": {}, \"texel\": {texel}, \"weight\": {}}}",
                tap.face,
                tap.level,
                json_number(tap.weight)
            )
        };
        taps.iter()
            .filter(|tap| tap.weight > 0.0)
            .map(json)
            .collect()
    });
    format!(
        "{{\"stage\": {}, \"coordinates\": {}, \"level\": {}, \"texels\": [{}]}}",
        sample.stage,
        json_vector(&coordinates),
        json_number(detail.lambda()),
        texels.join(", ")
    )
}

fn json_vector(numbers: &[f32]) -> String {
    let texts: Vec<String> = numbers.iter().map(|x| json_number(*x)).collect();
    format!("[{}]", texts.join(", "))
}

/// JSON has no infinities and no NaN; they are written as strings, as `eval` writes them.
fn json_number(x: f32) -> String {
    let text = number_text(x);
    if x.is_finite() { text } else { quoted(&text) }
}

fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => out.push_str(&format!("\\u{:04x}", c as u32)),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

// --- CSV ---

fn csv(runs: &[Run<'_>]) -> String {
    let mut out = String::from(
        "run,moment,line,text,register,components,\
         before_x,before_y,before_z,before_w,after_x,after_y,after_z,after_w,\
         first_write,reads,stage,u,v,w,level,remarks\n",
    );
    for run in runs {
        for (number, moment) in run.moments.iter().enumerate() {
            let entry = entry(run, moment);
            let mut cells = vec![
                tell::run_name(run),
                number.to_string(),
                entry.line.map_or(String::new(), |line| line.to_string()),
                entry.text,
                entry.register,
                entry.components,
            ];
            match entry.change {
                Some(change) => {
                    let lane = run.lane & 3;
                    let numbers = change.before[lane].iter().chain(&change.after[lane]);
                    cells.extend(numbers.map(|x| number_text(*x)));
                }
                None => cells.extend(std::iter::repeat_n(String::new(), 8)),
            }
            let first = entry
                .change
                .map(|change| components_text(run, change.first));
            cells.push(first.unwrap_or_default());
            cells.push(entry.reads.join("; "));
            match entry.sample {
                Some(sample) => {
                    let lane = run.lane & 3;
                    cells.push(sample.stage.to_string());
                    let level = sample.detail[lane].lambda();
                    let numbers = sample.coordinates[lane].into_iter().chain([level]);
                    cells.extend(numbers.map(number_text));
                }
                None => cells.extend(std::iter::repeat_n(String::new(), 5)),
            }
            cells.push(entry.remarks.join("; "));
            let cells: Vec<String> = cells.iter().map(|cell| csv_cell(cell)).collect();
            out.push_str(&cells.join(","));
            out.push('\n');
        }
    }
    out
}

/// Quoted where RFC 4180 asks for it.
fn csv_cell(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_string()
    }
}

// --- Markdown ---

fn markdown(runs: &[Run<'_>]) -> String {
    let mut out = String::new();
    for run in runs {
        let title = tell::run_title(run).to_string();
        out.push_str(&format!("## {}\n\n", markdown_cell(&title)));
        out.push_str("| line | instruction | register | value | from | remarks |\n");
        out.push_str("| ---: | --- | --- | --- | --- | --- |\n");
        for moment in &run.moments {
            let entry = entry(run, moment);
            let line = entry.line.map_or(String::new(), |line| line.to_string());
            let (register, value) = match entry.change {
                Some(change) => {
                    let kind = run.listing.kind();
                    let components = tell::mask_text(change.target, change.mask, kind);
                    (
                        format!("{}{components}", entry.register),
                        tell::numbers(change.after[run.lane & 3], change.mask),
                    )
                }
                None => Default::default(),
            };
            out.push_str(&format!(
                "| {line} | {} | {register} | {value} | {} | {} |\n",
                code(&entry.text),
                markdown_cell(&entry.reads.join(", ")),
                markdown_cell(&entry.remarks.join("; "))
            ));
        }
        out.push('\n');
    }
    out.truncate(out.trim_end().len());
    out.push('\n');
    out
}

fn code(text: &str) -> String {
    match text {
        "" => String::new(),
        text => format!("`{}`", text.replace('|', "\\|").replace('`', "'")),
    }
}

fn markdown_cell(text: &str) -> String {
    text.replace('|', "\\|")
}
