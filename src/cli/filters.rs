//! How exactly Mesa's software adapter filters.

/// The environment variable that Mesa's drivers of this kind look at.
const VARIABLE: &str = "GALLIVM_PERF";
const EXACT: &str = "no_aos_sampling";

/// Whether the driver was told to filter with floats.
pub(super) fn are_exact() -> bool {
    std::env::var(VARIABLE).is_ok_and(|value| value.contains(EXACT))
}

/// Starts the program again with the variable set, which the driver reads when it is loaded: else it filters with 8
/// bits, and a sample is off by up to 1.5 steps of 1/255. Whoever has set the variable is obeyed; where the program cannot
/// be started again, it goes on as it is.
pub(super) fn make_exact() {
    #[cfg(unix)]
    if std::env::var_os(VARIABLE).is_none()
        && let Ok(program) = std::env::current_exe()
    {
        use std::os::unix::process::CommandExt;
        let mut arguments = std::env::args_os();
        let mut again = std::process::Command::new(program);
        if let Some(name) = arguments.next() {
            again.arg0(name);
        }
        let _ = again.args(arguments).env(VARIABLE, EXACT).exec();
    }
}
