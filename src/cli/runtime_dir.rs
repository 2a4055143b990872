//! Silence on machines without a desktop.
//!
//! In each Vulkan instance, Mesa's device selection layer (22.3) tries to connect to a Wayland display. Without a desktop the
//! variable `XDG_RUNTIME_DIR` is not set, and libwayland then prints "error: XDG_RUNTIME_DIR is invalid or not set in the
//! environment." With the variable set it fails to connect without a word. A process cannot change its own environment in
//! safe Rust, so the program starts itself again in the same process.

/// A folder that holds no sockets, whether it exists or not.
#[cfg(target_os = "linux")]
const NO_SOCKETS: &str = "/var/empty";

/// Replaces the process by the same program with `XDG_RUNTIME_DIR` set, if it is not set to an absolute path.
///
/// Returns if there is nothing to do, or if the system refuses: the messages are then all that is wrong.
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
