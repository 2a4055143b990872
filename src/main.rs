//! The `hemicube` command: see `hemicube --help`.

fn main() {}
