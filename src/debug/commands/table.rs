//! The commands, a row each. Dispatch, help and completion read these rows and nothing else.

use super::{Arguments, Console, Fault, Outcome, Reply};
use super::{change, explain, export, info, look, scene, stopping, travel};
use crate::debug::session::Session;
use crate::debug::text::{Line, Style, Text};
use crate::syntax::distance;

/// A command.
pub(super) struct Command {
    /// Its name.
    pub(super) name: &'static str,
    /// Shorter and other names. Every beginning of a name that belongs to no other command works as well.
    pub(super) aliases: &'static [&'static str],
    /// What stands behind it.
    pub(super) arguments: &'static str,
    /// What it is about.
    group: Group,
    /// What it does, on one line.
    summary: &'static str,
    /// More about it.
    details: &'static str,
    /// Whether an empty line repeats it.
    pub(super) repeats: bool,
    /// Whether a format may stand behind a slash.
    pub(super) takes_format: bool,
    /// What completes its arguments.
    pub(super) takes: Takes,
    /// What does it.
    pub(super) run: Run,
}

type Run = fn(&mut Console, &mut Session<'_>, &Arguments<'_>) -> Outcome;

/// What a command is about, in the order of `help`.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Group {
    Move,
    Stop,
    Look,
    Explain,
    Change,
    Other,
}

/// The groups with their headings.
const GROUPS: [(Group, &str); 6] = [
    (Group::Move, "Moving"),
    (Group::Stop, "Stopping"),
    (Group::Look, "Looking"),
    (Group::Explain, "Explaining"),
    (Group::Change, "Changing"),
    (Group::Other, "Other"),
];

/// What stands behind a command.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Takes {
    /// Nothing that could be completed.
    Nothing,
    /// Registers and functions.
    Expression,
    /// A topic of `info`.
    Topic,
    /// Something to wait for.
    Occurrence,
    /// A command.
    Command,
    /// A format of `export`.
    ExportFormat,
}

use Group::{Change, Explain, Look, Move, Other, Stop};

/// A row with what most rows have.
const fn row(
    group: Group,
    name: &'static str,
    aliases: &'static [&'static str],
    run: Run,
) -> Command {
    Command {
        name,
        aliases,
        arguments: "",
        group,
        summary: "",
        details: "",
        repeats: false,
        takes_format: false,
        takes: Takes::Nothing,
        run,
    }
}

impl Command {
    const fn with(mut self, arguments: &'static str, summary: &'static str) -> Self {
        self.arguments = arguments;
        self.summary = summary;
        self
    }

    const fn more(mut self, details: &'static str) -> Self {
        self.details = details;
        self
    }

    const fn repeated(mut self) -> Self {
        self.repeats = true;
        self
    }

    const fn formatted(mut self) -> Self {
        self.takes_format = true;
        self
    }

    const fn completed(mut self, takes: Takes) -> Self {
        self.takes = takes;
        self
    }
}

pub(super) static COMMANDS: [Command; 47] = [
    row(Move, "step", &["s", "si", "stepi"], travel::step)
        .with("[N]", "one moment on, N times")
        .more("A moment is an input that gets its value, a row of a macro such as m4x4, a part of a texture instruction, any other \
               instruction, a stage of the output merger. A breakpoint or watchpoint on the way ends the steps.")
        .repeated(),
    row(Move, "reverse-step", &["rs", "back", "rsi"], travel::reverse_step)
        .with("[N]", "one moment back, N times")
        .more("Exactly undoes `step`.")
        .repeated(),
    row(Move, "next", &["n", "ni", "nexti"], travel::next)
        .with("[N]", "one instruction on, N times, a macro as a whole")
        .repeated(),
    row(Move, "reverse-next", &["rn", "rni"], travel::reverse_next)
        .with("[N]", "one instruction back, N times, a macro as a whole")
        .repeated(),
    row(Move, "continue", &["c", "fg"], travel::resume)
        .with("", "on to the next stop, or to the end of the last run")
        .repeated(),
    row(Move, "reverse-continue", &["rc"], travel::reverse_resume)
        .with("", "back to the next stop, or to the beginning of the first run")
        .repeated(),
    row(Move, "until", &["u"], travel::until)
        .with("nan|inf|clamp|uninit|range|sample|LINE", "on until something happens, or to a line")
        .more("nan: a result is NaN and nothing that was read is. inf: the same for infinity, and for the largest number, which rcp of 0 \
               gives. clamp: a clamp or _sat changes a value. uninit: something is read that was never written. range: c[a0.x + n] is \
               out of range. sample: a texture is sampled. One is then right behind it. Without an argument as `next`.")
        .repeated()
        .completed(Takes::Occurrence),
    row(Move, "reverse-until", &["ru", "reverse-advance", "ra"], travel::reverse_until)
        .with("nan|inf|clamp|uninit|range|sample|LINE", "back until something has happened, or to a line")
        .more("As `until`; one is then right before it.")
        .repeated()
        .completed(Takes::Occurrence),
    row(Move, "advance", &["adv"], travel::advance)
        .with("LINE", "on to a line")
        .more("LINE is 12, vs:12, ps:12 or FILE:12. A line without an instruction stands for the next one that has one.")
        .repeated(),
    row(Move, "finish", &["fin"], travel::finish)
        .with("", "to the end of this run")
        .more("From the end, to that of the next run.")
        .repeated(),
    row(Move, "reverse-finish", &["rfin"], travel::reverse_finish)
        .with("", "to the beginning of this run, before its inputs")
        .repeated(),
    row(Move, "start", &["run", "r"], travel::start)
        .with("[N]", "to the first instruction of the first run, or of run N"),
    row(Move, "goto", &["jump", "go"], travel::goto)
        .with("LINE|@N", "to a line, or to moment N of this run, without stopping on the way")
        .more("Log points are not written. @0 is before the inputs."),
    row(Move, "frame", &["f"], travel::frame)
        .with("[N]", "the runs of the vertices and of the pixel, or to the first instruction of run N"),
    row(Move, "up", &[], travel::up)
        .with("[N]", "to the run before: from the pixel to its vertices")
        .repeated(),
    row(Move, "down", &[], travel::down)
        .with("[N]", "to the run behind: from the vertices to the pixel")
        .repeated(),
    row(Stop, "break", &["b", "br"], stopping::breakpoint)
        .with("[LINE] [if EXPR]", "a breakpoint before a line, or before the next instruction")
        .more("LINE is 12, vs:12, ps:12 or FILE:12. A condition holds if any component is not zero: `break 12 if r2.x > 1`.")
        .completed(Takes::Expression),
    row(Stop, "tbreak", &["tb"], stopping::temporary)
        .with("[LINE] [if EXPR]", "a breakpoint that is deleted when it is hit")
        .completed(Takes::Expression),
    row(Stop, "dprintf", &["log"], stopping::log_point)
        .with("LINE,\"TEXT {EXPR}\"", "a text to write whenever a line is reached, without a stop")
        .more("Expressions stand in braces, with a format behind a colon if need be: dprintf 12,\"r2 is {r2.rgb}, {r2.a:x}\".")
        .completed(Takes::Expression),
    row(Stop, "watch", &["wa"], stopping::watchpoint)
        .with("REGISTER[.MASK] [if EXPR]", "a stop wherever one of these components changes")
        .more("The shader is the one of the run where one is.")
        .completed(Takes::Expression),
    row(Stop, "catch", &[], stopping::catch)
        .with("[nan|inf|clamp|uninit|range|sample]...", "a stop wherever this happens; without an argument what is caught")
        .completed(Takes::Occurrence),
    row(Stop, "uncatch", &[], stopping::uncatch)
        .with("[nan|inf|clamp|uninit|range|sample]...", "no more stops for this, or for anything that is caught")
        .completed(Takes::Occurrence),
    row(Stop, "delete", &["d", "del"], stopping::delete)
        .with("[ID]...", "deletes breakpoints and watchpoints, or all of them"),
    row(Stop, "disable", &["dis"], stopping::disable)
        .with("[ID]...", "switches breakpoints and watchpoints off, or all of them"),
    row(Stop, "enable", &["en"], stopping::enable)
        .with("[ID]...", "switches them on again"),
    row(Stop, "condition", &["cond"], stopping::condition)
        .with("ID [EXPR]", "gives a breakpoint or watchpoint a condition, or takes it away")
        .completed(Takes::Expression),
    row(Stop, "ignore", &["ig"], stopping::ignore)
        .with("ID N", "passes over the first N hits"),
    row(Stop, "hits", &[], stopping::hits)
        .with("ID [N|== N|>= N|> N|% N]", "stops at these hits only")
        .more("Hits are counted from the beginning of the first run, whichever way one came, and only where the condition holds."),
    row(Look, "print", &["p", "inspect"], look::print)
        .with("[/f|/x|/q|/c] EXPR", "the value of an expression")
        .more("/f is decimal, /x the 32 bits, /q the fixed point of the GeForce 3 and the Radeon 8500, /c a colour. Expressions: registers \
               with swizzles in either alphabet and source modifiers (r0.rgb, 1-r0, r1_bx2, c[a0.x + 2]), + - * /, comparisons, && || !, \
               (1, 0, 0) puts components together, tc0 are coordinates when t0 is a sample already, depth, killed; functions dp3 dp4 \
               length normalize abs min max sat isnan isinf floor frc rcp rsq exp log slt sge lrp cnd cmp.")
        .repeated()
        .formatted()
        .completed(Takes::Expression),
    row(Look, "display", &["disp"], look::display)
        .with("[/f|/x|/q|/c] [EXPR]", "shows an expression after every stop; without one, all that are shown")
        .formatted()
        .completed(Takes::Expression),
    row(Look, "undisplay", &["und"], look::undisplay)
        .with("[ID]...", "shows an expression no more, or none"),
    row(Look, "info", &["i"], info::info)
        .with("TOPIC", "registers, constants, inputs, outputs, textures, phase, budget, line, runs, breakpoints, display, all")
        .more("A dash stands for a component that nothing has written.")
        .repeated()
        .completed(Takes::Topic),
    row(Look, "list", &["l"], look::list)
        .with("[LINE]", "the lines around the next instruction or around a line, then those that follow")
        .repeated(),
    row(Look, "where", &["bt", "backtrace"], look::whereabouts)
        .with("", "which run, which instruction comes next, what is displayed"),
    row(Look, "quad", &[], explain::quad)
        .with("[REGISTER]...", "registers of the 2×2 pixels, helpers marked, and the levels of detail of the last sample")
        .repeated()
        .completed(Takes::Expression),
    row(Look, "show", &["sh"], scene::show)
        .with("all|REGISTER[@LINE]... [FILE.png]", "a register over the whole frame, after a line or after the last instruction")
        .completed(Takes::Expression),
    row(Explain, "why", &["w"], explain::why)
        .with("[REGISTER[.MASK]]", "the instructions that made a value, in their order, with what they read")
        .more("Operands that could not have made a difference are left out: a factor beside a zero, what cmp or cnd did not choose. Without a \
               register, the result r0.")
        .repeated()
        .completed(Takes::Expression),
    row(Explain, "history", &["hist"], scene::history)
        .with("[N]", "the primitives that touched the pixel and what became of each; debugs number N"),
    row(Explain, "diff", &[], change::diff)
        .with("", "the run before anything was set by hand beside the run as it is: where they part, and both results")
        .repeated(),
    row(Explain, "export", &["exp"], export::export)
        .with("json|csv|markdown [FILE]", "every moment of every run")
        .completed(Takes::ExportFormat),
    row(Change, "set", &[], change::set)
        .with("REGISTER[.MASK] = EXPR", "sets a register or a constant here, for all pixels of the quad, and runs on from here")
        .more("One number fills all components of the mask; four numbers give the mask its own. The old run is kept: `diff` shows both, \
               `unset` returns to it. Not between the parts of an instruction or the halves of a pair.")
        .completed(Takes::Expression),
    row(Change, "unset", &[], change::unset)
        .with("", "forgets everything that was set by hand"),
    row(Change, "pixel", &["pix"], scene::pixel)
        .with("X,Y [DRAW]", "debugs another pixel of the picture"),
    row(Change, "vertex", &["vert"], scene::vertex)
        .with("N [DRAW]", "debugs a vertex of the mesh of a draw"),
    row(Other, "help", &["h", "?"], help)
        .with("[COMMAND]", "the commands, or more about one")
        .more("Names can be shortened as long as they are clear. An empty line repeats the last command, if it is one that moves or looks. A \
               line that begins with # is a remark.")
        .completed(Takes::Command),
    row(Other, "echo", &[], echo)
        .with("TEXT", "writes a text, for scripts"),
    row(Other, "quit", &["q", "exit"], look::quit)
        .with("", "ends the session"),
];

/// The command that a word names: by its name, by an alias, or by a beginning that only one has.
pub(super) fn find(word: &str) -> Result<&'static Command, Fault> {
    let word = word.to_ascii_lowercase();
    let exact =
        |command: &&Command| command.name == word || command.aliases.contains(&word.as_str());
    if let Some(command) = COMMANDS.iter().find(exact) {
        return Ok(command);
    }
    let begun: Vec<_> = (COMMANDS.iter())
        .filter(|command| command.name.starts_with(&word) && !word.is_empty())
        .collect();
    match begun.as_slice() {
        [command] => Ok(command),
        [] => Err(unknown(
            "command",
            &word,
            COMMANDS.iter().map(|command| command.name),
        )),
        several => {
            let names: Vec<_> = several.iter().map(|command| command.name).collect();
            Err(format!("`{word}` can be {}", names.join(", ")).into())
        }
    }
}

/// That a word names nothing, with the nearest name that there is.
pub(super) fn unknown(what: &str, word: &str, names: impl Iterator<Item = &'static str>) -> Fault {
    let most = if word.len() > 4 { 2 } else { 1 };
    let nearest = names
        .map(|name| (distance(word, name), name))
        .filter(|(distance, _)| *distance <= most)
        // Of equally near ones that with the same first letter: it is seldom wrong.
        .min_by_key(|(distance, name)| (*distance, name.get(..1) != word.get(..1)));
    match nearest {
        Some((_, name)) => format!("`{word}` is no {what}; did you mean `{name}`?").into(),
        None => format!("`{word}` is no {what}; `help` lists them").into(),
    }
}

/// What is known about a command, for fronts that show help in their own way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CommandHelp {
    /// What it is about: the heading of its group.
    pub group: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Other names.
    pub aliases: &'static [&'static str],
    /// What stands behind it.
    pub arguments: &'static str,
    /// What it does, on one line.
    pub summary: &'static str,
    /// More about it; may be empty.
    pub details: &'static str,
}

/// All commands in the order of `help`.
pub fn command_help() -> impl Iterator<Item = CommandHelp> {
    GROUPS.into_iter().flat_map(|(group, heading)| {
        let of_group = move |command: &&Command| command.group == group;
        COMMANDS
            .iter()
            .filter(of_group)
            .map(move |command| CommandHelp {
                group: heading,
                name: command.name,
                aliases: command.aliases,
                arguments: command.arguments,
                summary: command.summary,
                details: command.details,
            })
    })
}

fn help(_: &mut Console, _: &mut Session<'_>, arguments: &Arguments<'_>) -> Outcome {
    /// How wide a paragraph is.
    const WIDTH: usize = 80;
    let mut text = Text::default();
    if arguments.text.is_empty() {
        let mut group = "";
        for command in command_help() {
            if command.group != group {
                group = command.group;
                text.line(Line::styled(group, Style::Strong));
            }
            let short = command.aliases.first().copied().unwrap_or("");
            let line = Line::from(format!("  {:<17}{short:<5}", command.name));
            text.line(line.plain(command.summary));
        }
        text.line("`help COMMAND` says more.");
        return Ok(text.into());
    }
    let command = find(arguments.text)?;
    let name = Line::styled(command.name, Style::Strong);
    text.line(name.plain(format!(" {}", command.arguments)));
    if !command.aliases.is_empty() {
        text.line(Line::styled(
            format!("  also {}", command.aliases.join(", ")),
            Style::Dim,
        ));
    }
    for paragraph in [command.summary, command.details] {
        let mut line = String::from(" ");
        for word in paragraph.split_whitespace() {
            if line.chars().count() + word.chars().count() >= WIDTH {
                text.line(std::mem::replace(&mut line, String::from(" ")));
            }
            line.push(' ');
            line.push_str(word);
        }
        if !line.trim().is_empty() {
            text.line(line);
        }
    }
    Ok(text.into())
}

fn echo(_: &mut Console, _: &mut Session<'_>, arguments: &Arguments<'_>) -> Outcome {
    Ok(Reply::from(arguments.text.to_string()))
}
