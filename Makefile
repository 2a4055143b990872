# Everything one needs to know to run, test and measure Hemicube.
# On Debian and Ubuntu the targets install what is missing (with sudo if need be); cargo itself is expected.

.PHONY: run test assets pictures bench setup

run: setup
	.ci/view

test: setup
	cargo test

# Writes assets/*.glb anew from src/scene/builtin.
assets:
	UPDATE_ASSETS=1 cargo test --test all assets

# Renders the pictures of README's tour anew.
pictures: setup
	.ci/pictures

bench:
	cargo bench

setup:
	.ci/setup
