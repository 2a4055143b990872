//! Suppresses a message of the Wayland library on machines without a desktop.
//!
//! In each Vulkan instance, Mesa's device selection layer (22.3) tries to connect to a Wayland display. Without a
//! desktop the variable `XDG_RUNTIME_DIR` is not set, and libwayland then prints "error: XDG_RUNTIME_DIR is invalid or
//! not set in the environment." If the variable is set, the connection fails without a message. Safe Rust cannot change
//! the environment of its own process, so the program is executed again in the same process with the variable set.

/// A folder without sockets. It need not exist.
#[cfg(target_os = "linux")]
const NO_SOCKETS: &str = "/var/empty";

/// Replaces the process by the same program with `XDG_RUNTIME_DIR` set, if it is not set to an absolute path.
///
/// Returns if there is nothing to do or the system refuses. If it refuses, the message is printed as before.
pub fn set_runtime_dir() {
    #[cfg(target_os = "linux")]
    {
        use std::os::unix::process::CommandExt;
        const NAME: &str = "XDG_RUNTIME_DIR";
        let is_set = std::env::var_os(NAME).is_some_and(|folder| std::path::Path::new(&folder).is_absolute());
        let mut args = std::env::args_os();
        if let (false, Some(name), Ok(program)) = (is_set, args.next(), std::env::current_exe()) {
            let error = std::process::Command::new(program).arg0(name).args(args).env(NAME, NO_SOCKETS).exec();
            log::debug!("the program cannot be started again: {error}");
        }
    }
}
