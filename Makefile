# Runs, tests and measures Hemicube.
# On Debian and Ubuntu the targets install missing system packages (with sudo if necessary); Rust itself has to be installed.

.PHONY: run test examples assets pictures bench setup

# Opens the viewer, or renders the built-in gallery if there is no display.
run: setup
	scripts/view

# Unit tests, integration tests and doctests, then each example.
test: setup
	cargo test
	$(MAKE) examples

examples: setup
	for file in examples/*.rs; do cargo run --quiet --example $$(basename $$file .rs) || exit 1; done

# Writes assets/*.glb from src/scene/builtin.
assets:
	UPDATE_ASSETS=1 cargo test --test all assets

# Renders the pictures of the tour.
pictures: setup
	scripts/pictures

bench:
	cargo bench

setup:
	scripts/setup
