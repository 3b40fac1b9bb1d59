//! Signals that end, stop and wake the program.

use super::{INSIDE, STALE, enter, leave};
use ratatui::crossterm::terminal::{disable_raw_mode, enable_raw_mode};
use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGWINCH};
use signal_hook::iterator::Signals;
use signal_hook::low_level::{emulate_default_handler, raise};
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{OnceLock, mpsc};
use std::time::Duration;

/// Whether the terminal was given back because the program was stopped.
static SUSPENDED: AtomicBool = AtomicBool::new(false);

/// How long giving the terminal back may take before a signal that ends the program does so.
const PATIENCE: Duration = Duration::from_secs(2);

/// Listens for signals from now on, in a thread of its own, so that they are heard while something is recorded or sent.
pub(super) fn listen() -> io::Result<()> {
    static LISTENING: OnceLock<()> = OnceLock::new();
    if LISTENING.get().is_some() {
        return Ok(());
    }
    let mut signals = Signals::new([SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGTSTP, SIGCONT])?;
    std::thread::Builder::new()
        .name("signals".to_string())
        .spawn(move || signals.forever().for_each(heard))?;
    let _ = LISTENING.set(());
    Ok(())
}

fn heard(signal: i32) {
    match signal {
        SIGTSTP => stop(),
        SIGCONT => go_on(),
        ending => {
            let (done, wait) = mpsc::channel();
            // A terminal that takes nothing any more must not keep the program alive.
            let helper = std::thread::Builder::new().spawn(move || {
                leave();
                let _ = done.send(());
            });
            if helper.is_ok() {
                let _ = wait.recv_timeout(PATIENCE);
            }
            let _ = emulate_default_handler(ending);
        }
    }
}

fn stop() {
    // A group of processes that no shell watches over could never be woken: the system itself does not stop such groups.
    let orphaned =
        rustix::process::getsid(None).is_ok_and(|leader| leader == rustix::process::getpgrp());
    if orphaned {
        return;
    }
    if INSIDE.load(Ordering::SeqCst) {
        SUSPENDED.store(true, Ordering::SeqCst);
        leave();
    }
    let _ = emulate_default_handler(SIGTSTP);
}

fn go_on() {
    if SUSPENDED.swap(false, Ordering::SeqCst) {
        // If this fails, the next thing that is drawn fails, too, and ends the program.
        let _ = enter();
    } else if INSIDE.load(Ordering::SeqCst) {
        // Stopped without having been asked: the shell has set the terminal as it likes it.
        let _ = disable_raw_mode().and_then(|()| enable_raw_mode());
    } else {
        return;
    }
    STALE.store(true, Ordering::SeqCst);
    // A change of size is what the loop that waits for events wakes up for.
    let _ = raise(SIGWINCH);
}

/// Stops the program as the shell's key for it does.
pub(super) fn suspend() {
    let _ = raise(SIGTSTP);
}
