//! The form factor of a pair by sampling: rays or hemicubes from points of the smaller polygon.

use glam::Vec3;

use super::pair::{Estimate, PolygonPair};
use super::polygon::Polygon;
use crate::base::ids::{InstanceId, MaterialId};
use crate::base::sampling::{r2, triangle_from_square};
use crate::form_factor::hemicube::Hemicubes;
use crate::form_factor::hemisphere::Hemispheres;
use crate::form_factor::{FormFactorError, FormFactorSource, Viewpoint, map_rows};
use crate::gpu::Gpu;
use crate::patch::{MeshSettings, PatchMesh};
use crate::scene::{Instance, Material, Scene, Triangle, Vertex};
use crate::trace::Tracer;

/// Number of points of the smaller polygon from which rays start, and number of rays per point.
const HEMISPHERES: (u32, u32) = (8192, 512);

/// Number of points of the smaller polygon at which hemicubes stand.
const NUM_HEMICUBES: u32 = 1024;

impl PolygonPair {
    /// Estimates the form factor with cosine-distributed rays from points of the smaller polygon.
    ///
    /// # Errors
    /// Returns the error of [`FormFactorSource::rows`], which does not fail with rays.
    pub fn by_hemispheres(&self) -> Result<Estimate, FormFactorError> {
        let scene = PairScene::new(self);
        let (num_points, num_rays) = HEMISPHERES;
        let tracer = Tracer::new(&scene.scene);
        let shares = scene.visible_shares(&mut Hemispheres::new(&tracer, &scene.mesh, num_rays), num_points)?;
        let factor = shares.iter().sum::<f64>() / shares.len() as f64;
        let error = Hemispheres::standard_error(factor, f64::from(num_points) * f64::from(num_rays));
        Ok(scene.reciprocal(Estimate { factor, error }))
    }

    /// Estimates the form factor with hemicubes `size_px` pixels wide at points of the smaller polygon.
    ///
    /// # Errors
    /// Returns an error if the device fails.
    pub fn by_hemicubes(&self, gpu: &Gpu, size_px: u32) -> Result<Estimate, FormFactorError> {
        let scene = PairScene::new(self);
        let mut hemicubes = Hemicubes::new(gpu, &scene.scene, &scene.mesh, size_px);
        let shares = scene.visible_shares(&mut hemicubes, NUM_HEMICUBES)?;
        let count = shares.len() as f64;
        let factor = shares.iter().sum::<f64>() / count;
        let variance = shares.iter().map(|value| (value - factor).powi(2)).sum::<f64>() / (count - 1.0);
        // This is an upper bound, because evenly spread points have smaller errors than independent ones.
        Ok(scene.reciprocal(Estimate { factor, error: (variance / count).sqrt() }))
    }
}

/// A pair as a scene in single precision, of about unit size round the origin: viewpoints lie on the smaller polygon,
/// the larger one and the blocker are the scene.
struct PairScene {
    scene: Scene,
    mesh: PatchMesh,
    viewer: Polygon,
    /// Number of triangles of the larger polygon, which come first.
    num_seen: usize,
    /// Form factor of the pair divided by the one from the viewer. If the two polygons are swapped, it is the ratio of
    /// their areas, by reciprocity.
    ratio: f64,
}

impl PairScene {
    fn new(pair: &PolygonPair) -> Self {
        let (viewer, seen, ratio) = if pair.a.area() <= pair.b.area() {
            (&pair.a, &pair.b, 1.0)
        } else {
            (&pair.b, &pair.a, pair.b.area() / pair.a.area())
        };
        let centre = viewer.centre();
        let reach = seen.corners().iter().chain(viewer.corners()).map(|p| p.distance(centre)).fold(0.0, f64::max);
        let rescaled = |polygon: &Polygon| polygon.rescaled(centre, 1.0 / reach);
        let material = Material::diffuse(Vec3::ONE);
        let mut scene = Scene {
            materials: vec![material.clone(), Material { double_sided: true, ..material }],
            ..Scene::default()
        };
        add(&mut scene, &rescaled(seen), 0);
        let num_seen = scene.triangles.len();
        if let Some(blocker) = &pair.blocker {
            add(&mut scene, &rescaled(blocker), 1);
        }
        let mesh = PatchMesh::new(&scene, &MeshSettings::uncut()).expect("a few triangles fit in memory");
        Self { scene, mesh, viewer: rescaled(viewer), num_seen, ratio }
    }

    /// Share of the view that the larger polygon fills, from each of `num_points` points.
    fn visible_shares(&self, source: &mut dyn FormFactorSource, num_points: u32) -> Result<Vec<f64>, FormFactorError> {
        map_rows(source, &self.viewpoints(num_points), &|| true, |_, row| {
            let is_seen = |e: usize| self.mesh.elements[e].triangle.index() < self.num_seen;
            row.entries.iter().filter(|entry| is_seen(entry.element.index())).map(|e| f64::from(e.factor)).sum()
        })
    }

    /// `num_points` points spread evenly over the viewer: each triangle of its fan has a sequence of its own, whose
    /// length is proportional to the area of the triangle.
    fn viewpoints(&self, num_points: u32) -> Vec<Viewpoint> {
        let corners = self.viewer.corners();
        let mut viewpoints = Vec::with_capacity(num_points as usize);
        let mut covered = 0.0;
        for k in 1..corners.len() - 1 {
            let [a, b, c] = [corners[0], corners[k], corners[k + 1]];
            covered += 0.5 * (b - a).cross(c - a).length() / self.viewer.area();
            let end = (covered * f64::from(num_points)).round() as usize;
            for i in 0..end.saturating_sub(viewpoints.len()) as u32 {
                let weights = triangle_from_square(r2(i, k as u32)).as_dvec3();
                let position = (a * weights.x + b * weights.y + c * weights.z).as_vec3();
                let seed = viewpoints.len() as u32;
                viewpoints.push(Viewpoint { position, normal: self.viewer.normal().as_vec3(), seed });
            }
        }
        viewpoints
    }

    /// Returns the estimate from A to B, by reciprocity if the viewer is B.
    fn reciprocal(&self, estimate: Estimate) -> Estimate {
        Estimate { factor: estimate.factor * self.ratio, error: estimate.error * self.ratio }
    }
}

/// Adds a polygon to a scene as a fan of triangles.
fn add(scene: &mut Scene, polygon: &Polygon, material: u32) {
    let first = scene.vertices.len() as u32;
    let start = scene.triangles.len();
    let normal = polygon.normal().as_vec3();
    let vertex = |position: Vec3| Vertex::new(position, normal);
    scene.vertices.extend(polygon.corners().iter().map(|corner| vertex(corner.as_vec3())));
    scene.triangles.extend((1..polygon.corners().len() as u32 - 1).map(|k| Triangle {
        vertices: [first, first + k, first + k + 1],
        material: MaterialId(material),
        instance: InstanceId::new(scene.instances.len()),
    }));
    scene.instances.push(Instance { name: String::new(), triangles: start..scene.triangles.len() });
}
