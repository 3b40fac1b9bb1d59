//! What was found, for people.

use super::{
    CHANNELS, Compared, Findings, FragmentComparison, LineComparison, Pixel, PixelComparison,
    TargetFace, register_name,
};
use std::fmt::Write;
use texcrd::gpu::{Differences, Pair, Parting, WorstPixel};
use texcrd::program::Program;
use texcrd::raster::Fate;

pub(super) fn report(findings: &Findings<'_>) -> String {
    let mut out = String::new();
    // Writing into a string cannot fail.
    let _ = whole(&mut out, findings);
    if let Some(pixel) = &findings.pixel {
        let _ = one_pixel(&mut out, findings, pixel);
    }
    let _ = verdict(&mut out, findings);
    out
}

/// The numbers of the whole picture.
fn whole(out: &mut String, findings: &Findings<'_>) -> std::fmt::Result {
    let Compared { inside, edges, .. } = &findings.picture;
    let [width, height] = findings.size;
    let (scene, adapter) = (&findings.arguments.scene, &findings.adapter);
    writeln!(
        out,
        "{scene}, {width}x{height}, CPU against {adapter}\n\
         differences in steps of 1/255      inside    on edges"
    )?;
    let mut row = |name: &str, of: &dyn Fn(&Differences) -> String| {
        writeln!(out, "  {name:<26} {:>12}{:>12}", of(inside), of(edges))
    };
    row("pixels", &|found| found.pixels().to_string())?;
    for (channel, name) in CHANNELS.iter().enumerate() {
        let max = |found: &Differences| found.max_of_channel[channel].to_string();
        row(&format!("greatest of {name}"), &max)?;
    }
    for (channel, name) in CHANNELS.iter().enumerate() {
        let mean = |found: &Differences| format!("{:.4}", found.mean_of_channel()[channel]);
        row(&format!("mean of {name}"), &mean)?;
    }
    writeln!(out, "pixels by the difference of their worst channel")?;
    for (step, _) in findings.all.counts() {
        let of = |found: &Differences| match found.count(step) {
            0 => String::new(),
            count => count.to_string(),
        };
        let row = format!("  {step:>26} {:>12}{:>12}", of(inside), of(edges));
        writeln!(out, "{}", row.trim_end())?;
    }
    if edges.above(findings.arguments.tolerance) > 0 {
        writeln!(
            out,
            "On edges, where depth bends from one pixel to the next, rounding decides which triangle covers a pixel:\n\
             both paths may show another one there. Lines are edges all along, and which pixels they cover is up to\n\
             the device."
        )?;
    }
    worst(out, "inside", inside.worst.as_ref())?;
    worst(out, "on edges", edges.worst.as_ref())?;
    targets(out, findings)
}

/// One row for each render target; faces together.
fn targets(out: &mut String, findings: &Findings<'_>) -> std::fmt::Result {
    let same = |a: &TargetFace, b: &TargetFace| a.target == b.target;
    for faces in findings.targets.chunk_by(same) {
        let name = faces.first().map_or("", |face| face.target.as_str());
        let of = |found: fn(&Compared) -> &Differences| {
            let found = || faces.iter().map(|face| found(&face.compared));
            let tolerance = findings.arguments.tolerance;
            let above: u64 = found().map(|found| found.above(tolerance)).sum();
            let max = found().map(Differences::max).max().unwrap_or(0);
            format!("at most {max} ({above} above {tolerance})")
        };
        let (inside, edges) = (of(|found| &found.inside), of(|found| &found.edges));
        writeln!(
            out,
            "render target `{name}`, which both paths sample as the CPU has it: inside {inside}, on edges {edges}"
        )?;
    }
    Ok(())
}

fn worst(out: &mut String, place: &str, worst: Option<&WorstPixel>) -> std::fmt::Result {
    match worst {
        Some(WorstPixel { x, y, cpu, gpu }) => writeln!(
            out,
            "worst {place} at {x},{y}: CPU {}, GPU {}",
            color(cpu),
            color(gpu)
        ),
        None => Ok(()),
    }
}

fn color(color: &[u8; 4]) -> String {
    let channels: Vec<String> = color.iter().map(u8::to_string).collect();
    channels.join(" ")
}

fn verdict(out: &mut String, findings: &Findings<'_>) -> std::fmt::Result {
    let tolerance = findings.arguments.tolerance;
    let place = match findings.arguments.strict {
        true => "",
        false => " inside triangles",
    };
    let [picture, targets] = findings.above();
    let levels = |compared: &[&Compared]| {
        let explained = compared
            .iter()
            .any(|compared| compared.beyond_levels.is_some());
        let error = findings.arguments.level_error;
        explained.then(|| format!(", levels of detail that are off by up to {error} left out"))
    };
    let sentence = |count: u64, compared: &[&Compared]| {
        let levels = levels(compared).unwrap_or_default();
        match count {
            0 => format!("no pixel{place} differs by more than {tolerance}{levels}"),
            1 => format!("1 pixel{place} differs by more than {tolerance}{levels}"),
            above => format!("{above} pixels{place} differ by more than {tolerance}{levels}"),
        }
    };
    let faces: Vec<_> = findings.targets.iter().map(|face| &face.compared).collect();
    writeln!(out, "\n{}", sentence(picture, &[&findings.picture]))?;
    if targets > 0 || levels(&faces).is_some() {
        writeln!(out, "in render targets: {}", sentence(targets, &faces))?;
    }
    Ok(())
}

/// What draws a pixel, and the registers of what is seen of it.
fn one_pixel(out: &mut String, findings: &Findings<'_>, pixel: &Pixel) -> std::fmt::Result {
    let comparison = match &pixel.comparison {
        Ok(comparison) => comparison,
        Err(error) => {
            return writeln!(out, "\nregisters cannot be compared: {error}");
        }
    };
    let [x, y] = comparison.pixel;
    let place = match pixel.inside {
        true => "inside",
        false => "on an edge",
    };
    let (cpu, gpu) = (color(&pixel.cpu), color(&pixel.gpu));
    writeln!(out, "\npixel {x},{y}, {place}: CPU {cpu}, GPU {gpu}")?;
    covered_by(out, findings, comparison)?;
    for fragment in &comparison.fragments {
        one_fragment(out, findings, fragment)?;
    }
    Ok(())
}

/// At most so many primitives are listed, the last ones.
const MOST_EVENTS: usize = 12;

fn covered_by(
    out: &mut String,
    findings: &Findings<'_>,
    comparison: &PixelComparison,
) -> std::fmt::Result {
    let draws = findings.draws();
    let events = &comparison.history.events;
    if events.is_empty() {
        return writeln!(out, "nothing is drawn there on the CPU");
    }
    let skipped = events.len().saturating_sub(MOST_EVENTS);
    let left_out = comparison.history.left_out + skipped;
    writeln!(out, "drawn there on the CPU, in this order")?;
    if left_out > 0 {
        writeln!(out, "  … {left_out} more before these")?;
    }
    for event in events.iter().skip(skipped) {
        let name = draws.get(event.draw).map_or("", |draw| draw.name);
        let fate = match event.merge.fate() {
            Fate::Written => color(&event.merge.after.color),
            Fate::Killed => "taken out by texkill".into(),
            fate @ (Fate::AlphaTest | Fate::Stencil | Fate::Depth) => {
                format!("fails the {} test", fate.name())
            }
        };
        let primitive = event.fragment.primitive;
        writeln!(out, "  `{name}`, primitive {primitive}: {fate}")?;
    }
    Ok(())
}

fn one_fragment(
    out: &mut String,
    findings: &Findings<'_>,
    fragment: &FragmentComparison,
) -> std::fmt::Result {
    let draws = findings.draws();
    let Some(draw) = draws.get(fragment.event.draw) else {
        return Ok(());
    };
    let program = &draw.pixel.program;
    let (file, _) = findings.place(program.version_span);
    let (name, primitive) = (draw.name, fragment.event.fragment.primitive);
    writeln!(out, "\n`{name}`, primitive {primitive}, {file}")?;
    if !fragment.covered {
        return writeln!(
            out,
            "  The GPU does not cover the pixel by this primitive: an edge passes, and no instruction is to blame."
        );
    }
    writeln!(
        out,
        "  {:<14}{:<45}{:<45}difference",
        "inputs", "CPU", "GPU"
    )?;
    pairs(out, program, &fragment.inputs)?;
    writeln!(out, "  registers at the end")?;
    pairs(out, program, &fragment.registers())?;
    if fragment.killed != [false; 2] {
        let by = |killed: bool| if killed { "discarded" } else { "kept" };
        let [cpu, gpu] = fragment.killed.map(by);
        writeln!(out, "  texkill: {cpu} on the CPU, {gpu} on the GPU")?;
    }
    parting(out, findings, program, fragment)?;
    if findings.arguments.all_lines {
        all_lines(out, findings, program, fragment)?;
    }
    Ok(())
}

fn pairs(out: &mut String, program: &Program, pairs: &[Pair]) -> std::fmt::Result {
    for pair in pairs {
        let name = format!(
            "{}{}",
            register_name(program, pair.slot),
            pair.mask.text(program.letters())
        );
        let (cpu, gpu) = (numbers(pair, pair.cpu), numbers(pair, pair.gpu));
        writeln!(
            out,
            "      {name:<10}{cpu:<45}{gpu:<45}{}",
            small(pair.difference())
        )?;
    }
    Ok(())
}

fn numbers(pair: &Pair, value: [f32; 4]) -> String {
    let of = |component: usize| match pair.mask.has(component) {
        true => number(value[component]),
        false => "-".to_string(),
    };
    let columns: Vec<String> = (0..4).map(|c| format!("{:<10}", of(c))).collect();
    columns.join(" ")
}

/// Seven digits, which is what a float holds, in nine or ten columns.
fn number(value: f32) -> String {
    let size = value.abs();
    match size {
        0.0 => "0".into(),
        1e-3..1e1 => format!("{value:.6}"),
        1e1..1e5 => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    }
}

/// A difference.
fn small(value: f32) -> String {
    match value {
        0.0 => "0".into(),
        _ => format!("{value:.1e}"),
    }
}

fn parting(
    out: &mut String,
    findings: &Findings<'_>,
    program: &Program,
    fragment: &FragmentComparison,
) -> std::fmt::Result {
    let tolerance = findings.arguments.part_tolerance;
    let parting = fragment.parting(tolerance);
    let explanation = fragment.explanation(tolerance);
    match parting {
        Parting::Nowhere => writeln!(
            out,
            "  No instruction's registers part by more than {tolerance:.1e}. What differs comes after the shader:\n  \
             rounding to 8 bits, fog, blending, or what was drawn before."
        )?,
        Parting::Inputs => writeln!(
            out,
            "  The interpolated inputs part already, by more than {tolerance:.1e}: so do vertex shader or interpolation."
        )?,
        Parting::Line(line) => {
            let (file, number) = findings.place(line.span);
            writeln!(
                out,
                "  Registers part first, by more than {tolerance:.1e}, at {file}:{number}"
            )?;
            one_line(out, findings, program, line)?;
        }
    }
    let Some(line) = explanation.filter(|line| parting != Parting::Line(line)) else {
        return Ok(());
    };
    let (file, number) = findings.place(line.span);
    writeln!(
        out,
        "  They are apart by a quarter or more of what r0 is in the end first at {file}:{number}"
    )?;
    one_line(out, findings, program, line)
}

/// What an instruction reads and writes.
fn one_line(
    out: &mut String,
    findings: &Findings<'_>,
    program: &Program,
    line: &LineComparison,
) -> std::fmt::Result {
    writeln!(out, "    {}", findings.instruction(line))?;
    if !line.reads.is_empty() {
        writeln!(out, "    reads")?;
        pairs(out, program, &line.reads)?;
    }
    if !line.writes.is_empty() {
        writeln!(out, "    writes")?;
        pairs(out, program, &line.writes)?;
    }
    if let Some([cpu, gpu]) = line.kills {
        let by = |kills: bool| if kills { "discards" } else { "keeps" };
        writeln!(
            out,
            "    the CPU {} the pixel, the GPU {} it",
            by(cpu),
            by(gpu)
        )?;
    }
    for texture in &line.samples {
        let (stage, name) = (texture.stage, &texture.name);
        writeln!(out, "    samples `{name}` (stage {stage})")?;
    }
    Ok(())
}

/// One row for each register that an instruction writes.
fn all_lines(
    out: &mut String,
    findings: &Findings<'_>,
    program: &Program,
    fragment: &FragmentComparison,
) -> std::fmt::Result {
    writeln!(
        out,
        "  {:<6}{:<40}{:<16}{:<13}relative",
        "line", "instruction", "register", "difference"
    )?;
    let tolerance = findings.arguments.part_tolerance;
    for line in &fragment.lines {
        let (_, number) = findings.place(line.span);
        let mut head = (number.to_string(), findings.instruction(line));
        let parted = |apart: bool| if apart { "  parted" } else { "" };
        for write in &line.writes {
            let register = format!(
                "{}{}",
                register_name(program, write.slot),
                write.mask.text(program.letters())
            );
            let (absolute, relative) = (write.difference(), write.relative_difference());
            writeln!(
                out,
                "  {:<6}{:<40}{register:<16}{:<13}{}{}",
                head.0,
                head.1,
                small(absolute),
                small(relative),
                parted(relative > tolerance)
            )?;
            head = Default::default();
        }
        if let Some([cpu, gpu]) = line.kills {
            let (number, text) = head;
            writeln!(
                out,
                "  {number:<6}{text:<40}{:<16}{}",
                "",
                parted(cpu != gpu).trim_start()
            )?;
        }
    }
    Ok(())
}
