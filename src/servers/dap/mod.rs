//! The debug adapter: `texcrd dap`, the debug adapter protocol on a pair of streams.
//!
//! The adapter translates: a session of [`texcrd::debug`] knows what happened in a shader, the client knows how to show it to a
//! person. One program is debugged at a time; all of it was recorded before the first question comes, so that nothing runs while
//! the client waits, and going back is as good as going on.
//!
//! Files: `connection` (messages, in and out), `protocol` (their contents), `client` (what the client is like), `launch` (what is
//! debugged), `adapter` (a launched program), and the requests by what they are about: `breakpoints`, `travel`, `variables` with
//! `values` and `textures`, `evaluate`, `sources`.

mod adapter;
mod breakpoints;
mod client;
mod connection;
mod evaluate;
mod launch;
mod protocol;
mod sources;
#[cfg(test)]
mod tests;
mod textures;
mod travel;
mod values;
mod variables;

use adapter::Adapter;
use breakpoints::Wanted;
use client::{Client, capabilities};
use connection::Connection;
use launch::{Loaded, Problem};
use protocol::{Answer, Event, LaunchArguments, Refusal, Request, RestartArguments};
use sources::Sources;
use std::io::{self, BufRead, Write};
use std::path::Path;
use texcrd::diagnostic::{Diagnostic, SourceMap};

/// What the program has already that an adapter needs.
#[derive(Clone, Copy)]
pub(crate) struct Tools {
    /// A diagnostic for people; with the colours of a terminal if the last says so.
    pub(crate) rendered: fn(&SourceMap, &Diagnostic, bool) -> String,
    /// Writes a file whole or not at all; an error in words.
    pub(crate) write: fn(&Path, &[u8]) -> Result<(), String>,
}

/// Serves a client until it goes away.
///
/// # Errors
/// What the output says.
pub(crate) fn serve(input: impl BufRead, output: impl Write, tools: Tools) -> io::Result<()> {
    let mut server = Server {
        connection: Connection::new(input, output),
        tools,
        wanted: Wanted::default(),
    };
    let Some(client) = server.greet()? else {
        return Ok(());
    };
    let Some(mut next) = server.launch(&client)? else {
        return Ok(());
    };
    loop {
        let (request, loaded) = next;
        let left = match loaded.open(|session| {
            let sources = Sources::new(loaded.sources());
            let adapter = Adapter::new(
                session,
                sources,
                &client,
                &loaded.arguments,
                tools,
                &mut server.wanted,
            );
            debug(&mut server.connection, adapter, &loaded, tools, &request)
        }) {
            Ok(left) => left?,
            Err(problem) => {
                server.refuse(&client, &request, problem)?;
                if request.command == "restart" {
                    server.connection.tell(&Event::bare("terminated"))?;
                }
                Left::Nothing
            }
        };
        next = match left {
            Left::Client => return Ok(()),
            Left::Restart(request, loaded) => (request, *loaded),
            Left::Nothing => match server.launch(&client)? {
                Some(next) => next,
                None => return Ok(()),
            },
        };
    }
}

/// Why a program is not debugged any more.
enum Left {
    /// The client has gone.
    Client,
    /// It is to be debugged from the beginning.
    Restart(Request, Box<Loaded>),
    /// There was nothing to debug.
    Nothing,
}

struct Server<R, W> {
    connection: Connection<R, W>,
    tools: Tools,
    wanted: Wanted,
}

impl<R: BufRead, W: Write> Server<R, W> {
    /// Waits for the client to introduce itself; `None` if it goes away before.
    fn greet(&mut self) -> io::Result<Option<Client>> {
        while let Some(request) = self.connection.next()? {
            match request.command.as_str() {
                "initialize" => {
                    let client = request.read().and_then(|arguments| Client::new(&arguments));
                    match client {
                        Ok(client) => {
                            let answer = Answer::of(&capabilities());
                            self.connection.respond(&request, Ok(answer))?;
                            return Ok(Some(client));
                        }
                        Err(refusal) => self.connection.respond(&request, Err(refusal))?,
                    };
                }
                "disconnect" => {
                    self.connection.respond(&request, Ok(Answer::default()))?;
                    return Ok(None);
                }
                _ => {
                    let refusal = Refusal::request("the first request must be `initialize`");
                    self.connection.respond(&request, Err(refusal))?;
                }
            }
        }
        Ok(None)
    }

    /// Waits for something to debug; `None` if the client goes away before. What it configures already is kept.
    fn launch(&mut self, client: &Client) -> io::Result<Option<(Request, Loaded)>> {
        while let Some(request) = self.connection.next()? {
            let handled = match request.command.as_str() {
                "launch" => {
                    let loaded = (request.read::<LaunchArguments>())
                        .map_err(|refusal| Problem::from(refusal.message))
                        .and_then(Loaded::new);
                    match loaded {
                        Ok(loaded) => return Ok(Some((request, loaded))),
                        Err(problem) => {
                            self.refuse(client, &request, problem)?;
                            continue;
                        }
                    }
                }
                "disconnect" => {
                    self.connection.respond(&request, Ok(Answer::default()))?;
                    return Ok(None);
                }
                "terminate" => Ok(Answer::done(vec![Event::bare("terminated")])),
                "setBreakpoints" => request.read().and_then(|a| self.wanted.set_lines(&a)),
                "setDataBreakpoints" => request.read().and_then(|a| self.wanted.set_data(&a)),
                "setExceptionBreakpoints" => {
                    request.read().and_then(|a| self.wanted.set_occurrences(&a))
                }
                "initialize" => Err(Refusal::request("`initialize` comes only once")),
                "attach" => Err(Refusal::launch("nothing can be attached to: launch it")),
                _ => Err(Refusal::here("nothing is launched")),
            };
            self.connection.respond(&request, handled)?;
        }
        Ok(None)
    }

    /// Says why something cannot be debugged: first in full, then in one line.
    fn refuse(&mut self, client: &Client, request: &Request, problem: Problem) -> io::Result<()> {
        for event in problem.events(client, self.tools) {
            self.connection.tell(&event)?;
        }
        self.connection.respond(request, Err(problem.refusal))?;
        Ok(())
    }
}

/// Debugs a program until the client has enough of it.
fn debug<R: BufRead, W: Write>(
    connection: &mut Connection<R, W>,
    mut adapter: Adapter<'_, '_>,
    loaded: &Loaded,
    tools: Tools,
    request: &Request,
) -> io::Result<Left> {
    let mut events = loaded.warnings(adapter.client, tools);
    events.extend(adapter.resolve());
    match request.command.as_str() {
        // The client has configured everything already.
        "restart" => events.extend(adapter.run()),
        // Now breakpoints can be put where instructions are.
        _ => events.push(Event::bare("initialized")),
    }
    connection.respond(request, Ok(Answer::done(events)))?;
    while let Some(request) = connection.next()? {
        let handled = match request.command.as_str() {
            "disconnect" => {
                connection.respond(&request, Ok(Answer::default()))?;
                return Ok(Left::Client);
            }
            "terminate" => Ok(Answer::done(vec![Event::bare("terminated")])),
            "launch" | "attach" => Err(Refusal::request("something is launched already")),
            "initialize" => Err(Refusal::request("`initialize` comes only once")),
            "restart" => {
                let arguments = request.read::<RestartArguments>();
                let loaded = arguments
                    .map_err(|refusal| Problem::from(refusal.message))
                    .and_then(|restart| {
                        let before = || loaded.arguments.clone();
                        Loaded::new(restart.arguments.unwrap_or_else(before))
                    });
                match loaded {
                    Ok(loaded) => return Ok(Left::Restart(request, Box::new(loaded))),
                    Err(problem) => {
                        // What was debugged before still can be.
                        for event in problem.events(adapter.client, tools) {
                            connection.tell(&event)?;
                        }
                        Err(problem.refusal)
                    }
                }
            }
            _ => adapter.handle(&request),
        };
        connection.respond(&request, handled)?;
    }
    Ok(Left::Client)
}
