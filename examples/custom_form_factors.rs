//! Uses a custom form-factor method with a solver of this crate.
//!
//! In an empty convex room nothing blocks the view, so Lambert's closed form gives every form factor exactly. The
//! example solves such a room with it and with the cosine-distributed rays of the crate, and compares the two.

use std::error::Error;

use hemicube::base::colour::luminance;
use hemicube::base::ids::ElementId;
use hemicube::base::progress::Unwatched;
use hemicube::form_factor::hemisphere::Hemispheres;
use hemicube::form_factor::{Entry, FormFactorError, Row, Viewpoint, point_to_polygon};
use hemicube::glam::Vec3;
use hemicube::patch::{MeshSettings, PatchMesh};
use hemicube::radiosity::direct::{DirectLight, direct_on_elements};
use hemicube::radiosity::solver::progressive::{Progressive, ProgressiveSettings};
use hemicube::radiosity::{Field, Viewpoints};
use hemicube::scene::{Light, Material};
use hemicube::trace::Tracer;
use hemicube::{FormFactorSource, SceneBuilder};

/// Form factors in closed form, of a mesh in which nothing blocks the view.
struct ClosedForm<'a> {
    mesh: &'a PatchMesh,
}

impl FormFactorSource for ClosedForm<'_> {
    fn rows(
        &mut self,
        viewpoints: &[Viewpoint],
        may_continue: &dyn Fn() -> bool,
        visit: &(dyn Fn(usize, &Row) + Sync),
    ) -> Result<usize, FormFactorError> {
        for (index, viewpoint) in viewpoints.iter().enumerate() {
            if !may_continue() {
                return Ok(index);
            }
            let factor = |element| point_to_polygon(viewpoint.position, viewpoint.normal, &self.mesh.corners(element));
            let entries = self.mesh.elements.iter().enumerate();
            let entries = entries.map(|(e, element)| Entry { element: ElementId::new(e), factor: factor(element) });
            let mut row = Row { entries: entries.filter(|entry| entry.factor > 0.0).collect(), ..Row::default() };
            // A row sums to 1; the room is closed, so only rounding is left for the sky.
            row.sky = (1.0 - row.entries.iter().map(|entry| entry.factor).sum::<f32>()).max(0.0);
            visit(index, &row);
        }
        Ok(viewpoints.len())
    }

    /// A closed form has no noise.
    fn num_samples(&self) -> usize {
        usize::MAX
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut builder = SceneBuilder::new("empty room");
    let grey = builder.material(Material::diffuse(Vec3::splat(0.5)));
    builder.room(Vec3::ZERO, Vec3::new(4.0, 3.0, 5.0), [grey; 6]);
    let group = builder.group("lamp");
    builder.light(Light { group, ..Light::point(Vec3::new(1.0, 2.0, 1.5), Vec3::splat(100.0)) });
    let scene = builder.build();

    // Elements receive light, patches shoot it. Direct light on the elements is the start of the solution.
    let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.5, patch_size: 1.0 })?;
    let tracer = Tracer::new(&scene);
    let viewpoints = Viewpoints::new(&scene);
    let lights = DirectLight::new(&scene, &mesh, &tracer, 16);
    let direct = direct_on_elements(&mesh, &viewpoints, &lights, 4, &Unwatched);

    let solve = |source: &mut dyn FormFactorSource| -> Result<Field, FormFactorError> {
        let settings = ProgressiveSettings {
            threshold: 0.001,
            max_shots_a_patch: 64,
            points_a_patch: 1,
            patches_a_batch: 8,
            row_bytes: 64 << 20,
        };
        let mut solver = Progressive::new(&mesh, viewpoints, direct.clone(), settings);
        while !solver.is_done() {
            solver.step(source, &Unwatched)?;
        }
        Ok(solver.into_parts().0.indirect)
    };
    let exact = solve(&mut ClosedForm { mesh: &mesh })?;
    let sampled = solve(&mut Hemispheres::new(&tracer, &mesh, 1 << 14))?;

    // The mean indirect irradiance of all elements, weighted by area.
    let area: f32 = mesh.elements.iter().map(|element| element.area).sum();
    let mean = |field: &Field| {
        let parts = mesh.elements.iter().enumerate();
        parts.map(|(e, element)| luminance(field.total(e)) * element.area).sum::<f32>() / area
    };
    let [exact, sampled] = [&exact, &sampled].map(mean);
    println!("{} elements, mean indirect irradiance:", mesh.elements.len());
    println!("  closed form {exact:.3} lx, cosine rays {sampled:.3} lx");
    assert!((exact - sampled).abs() < 0.01 * exact);
    Ok(())
}
