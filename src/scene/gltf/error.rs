//! Errors of loading a glTF file, each a message of one line with the file and the cause.

/// A file that cannot be loaded.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {cause}")]
pub struct LoadError {
    /// Path as the user gave it, or the name given with the bytes of the file.
    pub file: String,
    /// The reason.
    pub cause: Cause,
}

/// Reason why a file cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum Cause {
    /// The file does not exist.
    #[error("there is no such file")]
    NoSuchFile,
    /// The operating system reports an error.
    #[error("it cannot be read: {0}")]
    Unreadable(String),
    /// The file is neither binary glTF nor JSON.
    #[error("it is not a glTF file: {0}")]
    NotGltf(String),
    /// The file has fewer bytes than its header states.
    #[error("it is cut off: {found} of {expected} bytes are there")]
    CutOff {
        /// Number of bytes according to the header.
        expected: usize,
        /// Number of bytes in the file.
        found: usize,
    },
    /// The version is not glTF 2.
    #[error("it is glTF version {0}; only version 2 can be read (gltf-pipeline converts version 1)")]
    Version(String),
    /// The file requires an extension that is not supported.
    #[error("it requires the extension {name}, which is not supported; {hint}")]
    RequiredExtension {
        /// Name in `extensionsRequired`.
        name: String,
        /// What the user can do about it.
        hint: &'static str,
    },
    /// The file has no scene of the name or index in `FILE#SCENE`.
    #[error("it has no scene {wanted:?}; there is {available}")]
    NoSuchScene {
        /// Name or index after the `#`.
        wanted: String,
        /// The scenes of the file.
        available: String,
    },
    /// An index refers to an item that does not exist.
    #[error("{user} refers to {kind} {index}, which does not exist")]
    DanglingIndex {
        /// The referring item.
        user: String,
        /// Kind of the missing item.
        kind: &'static str,
        /// The index.
        index: usize,
    },
    /// The bytes of a buffer cannot be read.
    #[error("buffer {buffer}: {problem}")]
    Buffer {
        /// Index of the buffer.
        buffer: usize,
        /// What is wrong.
        problem: String,
    },
    /// A buffer view reaches outside its buffer.
    #[error("buffer view {view} reaches outside buffer {buffer}")]
    BufferView {
        /// Index of the view.
        view: usize,
        /// Index of its buffer.
        buffer: usize,
    },
    /// An accessor cannot be read.
    #[error("accessor {accessor}: {problem}")]
    Accessor {
        /// Index of the accessor.
        accessor: usize,
        /// What is wrong.
        problem: String,
    },
    /// A part of the file contradicts itself or the standard; the message describes it.
    #[error("{0}")]
    Broken(String),
    /// The file has no material variant of the given name.
    #[error("it has no variant {wanted:?}; there is {available}")]
    NoSuchVariant {
        /// Name of the variant.
        wanted: String,
        /// Names of the file's variants.
        available: String,
    },
    /// A number is NaN, infinite, or implausibly large for its unit.
    #[error("{0} is not a finite number of plausible size")]
    NotFinite(String),
    /// A node is its own ancestor or has two parents.
    #[error("node {0} occurs twice in the node tree (a loop, or two parents)")]
    NodeTwice(usize),
    /// The node tree is too deep.
    #[error("the node tree is deeper than {0} levels")]
    TooDeep(usize),
    /// The file or the scene exceeds a limit on memory.
    #[error("it is too large: {0}")]
    TooLarge(String),
}

impl Cause {
    /// Returns [`Self::Accessor`] with this problem.
    pub(super) fn accessor(accessor: usize, problem: impl Into<String>) -> Self {
        Self::Accessor { accessor, problem: problem.into() }
    }
}
