//! Form factor between two polygons by each of the three methods, with a third polygon that may stand between.

use glam::{DVec3, Vec3};

use super::contour::polygon_to_polygon;
use super::hemicube::Hemicubes;
use super::hemisphere::Hemispheres;
use super::polygon::{Plane, Polygon};
use super::quadrature::integrate_triangle;
use super::{FormFactorError, FormFactors, Viewpoint, map_rows};
use crate::base::ids::{InstanceId, MaterialId};
use crate::base::sampling::{r2, triangle_from_square};
use crate::gpu::Gpu;
use crate::patch::{MeshSettings, PatchMesh};
use crate::scene::{Instance, Material, Scene, Triangle, Vertex};
use crate::trace::Tracer;

/// Two polygons that exchange light, and one that may stand between. The two have fronts; the blocker blocks both ways.
#[derive(Clone, Debug)]
pub struct PolygonPair {
    /// Where light leaves.
    pub a: Polygon,
    /// Where it arrives.
    pub b: Polygon,
    /// What stands between.
    pub blocker: Option<Polygon>,
}

/// A form factor and how well it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// F from A to B, 0..1.
    pub factor: f64,
    /// Its standard error; for closed forms what the quadrature may be off.
    pub error: f64,
}

/// Points of the smaller polygon from which rays start, and rays a point.
const HEMISPHERES: (u32, u32) = (8192, 512);

/// Points of the smaller polygon on which hemicubes stand.
const NUM_HEMICUBES: u32 = 1024;

/// Absolute error of the closed form behind a blocker.
const TOLERANCE: f64 = 1e-8;

impl PolygonPair {
    /// By closed forms: contour integrals, less what the blocker hides.
    ///
    /// Equation: F = F(A, B) - 1/A x integral over A of the point-to-polygon form factor of the part of B in the blocker's
    /// shadow.
    #[must_use]
    pub fn analytic(&self) -> Estimate {
        let open = polygon_to_polygon(&self.a, &self.b);
        let (hidden, error) = self.hidden().unwrap_or((0.0, 1e-8));
        Estimate { factor: (open - hidden).clamp(0.0, 1.0), error }
    }

    /// What the blocker takes away, with its error; none where it stands aside.
    fn hidden(&self) -> Option<(f64, f64)> {
        let (a, b) = (self.a.within(&self.b.plane())?, self.b.within(&self.a.plane())?);
        // Only what is in front of both stands between.
        let blocker = self.blocker.as_ref()?.within(&self.a.plane())?.within(&self.b.plane())?;
        let normal = self.a.normal();
        let from_point = |point: DVec3| shadow(point, &blocker, &b).map_or(0.0, |part| seen_from(point, normal, &part));
        let corners = a.corners();
        let tolerance = TOLERANCE * self.a.area() / (corners.len() - 2) as f64;
        let triangles = (1..corners.len() - 1).map(|i| [corners[0], corners[i], corners[i + 1]]);
        let (sum, error) = triangles
            .map(|triangle| integrate_triangle(&from_point, triangle, tolerance))
            .fold((0.0, 0.0), |whole, part| (whole.0 + part.0, whole.1 + part.1));
        Some((sum / self.a.area(), error / self.a.area()))
    }

    /// By rays with the density of the cosine, from points of the smaller polygon.
    ///
    /// # Errors
    /// None in truth; the trait has one.
    pub fn by_hemispheres(&self) -> Result<Estimate, FormFactorError> {
        let staged = Staged::new(self);
        let (num_points, num_rays) = HEMISPHERES;
        let tracer = Tracer::new(&staged.scene);
        let seen = staged.seen(&mut Hemispheres::new(&tracer, &staged.mesh, num_rays), num_points)?;
        let factor = seen.iter().sum::<f64>() / seen.len() as f64;
        let error = Hemispheres::standard_error(factor, f64::from(num_points) * f64::from(num_rays));
        Ok(staged.turned(Estimate { factor, error }))
    }

    /// By hemicubes `size_px` pixels wide on points of the smaller polygon.
    ///
    /// # Errors
    /// The device failed.
    pub fn by_hemicubes(&self, gpu: &Gpu, size_px: u32) -> Result<Estimate, FormFactorError> {
        let staged = Staged::new(self);
        let seen = staged.seen(&mut Hemicubes::new(gpu, &staged.scene, &staged.mesh, size_px), NUM_HEMICUBES)?;
        let count = seen.len() as f64;
        let factor = seen.iter().sum::<f64>() / count;
        let variance = seen.iter().map(|value| (value - factor).powi(2)).sum::<f64>() / (count - 1.0);
        // Evenly spread points do better than independent ones.
        Ok(staged.turned(Estimate { factor, error: (variance / count).sqrt() }))
    }
}

/// The part of `b` that lies in the shadow of `blocker` from `point`.
fn shadow(point: DVec3, blocker: &Polygon, b: &Polygon) -> Option<Polygon> {
    let inside = blocker.centre() - point;
    let mut part = b.clone();
    for (start, end) in blocker.edges() {
        let normal = (start - point).cross(end - point).try_normalize()?;
        let normal = if normal.dot(inside) < 0.0 { -normal } else { normal };
        part = part.within(&Plane { normal, point })?;
    }
    Some(part)
}

/// Form factor from a small surface to a polygon above its horizon (Lambert 1760).
fn seen_from(point: DVec3, normal: DVec3, polygon: &Polygon) -> f64 {
    let term = |(a, b): (DVec3, DVec3)| {
        let (a, b) = (a - point, b - point);
        let cross = a.cross(b);
        let length = cross.length();
        if length > 0.0 { length.atan2(a.dot(b)) * normal.dot(cross) / length } else { 0.0 }
    };
    (polygon.edges().map(term).sum::<f64>() / std::f64::consts::TAU).abs()
}

/// A pair as a scene in single precision, of about unit size round the origin: the smaller polygon looks, the larger one and
/// the blocker are there to be seen.
struct Staged {
    scene: Scene,
    mesh: PatchMesh,
    viewer: Polygon,
    /// Triangles of the larger polygon, which come first.
    num_seen: usize,
    /// Form factor of the pair over that from the viewer: the other way round the areas decide.
    ratio: f64,
}

impl Staged {
    fn new(pair: &PolygonPair) -> Self {
        let (viewer, seen, ratio) = if pair.a.area() <= pair.b.area() {
            (&pair.a, &pair.b, 1.0)
        } else {
            (&pair.b, &pair.a, pair.b.area() / pair.a.area())
        };
        let centre = viewer.centre();
        let reach = seen.corners().iter().chain(viewer.corners()).map(|p| p.distance(centre)).fold(0.0, f64::max);
        let stage = |polygon: &Polygon| polygon.rescaled(centre, 1.0 / reach);
        let material = Material::diffuse(Vec3::ONE);
        let mut scene = Scene {
            materials: vec![material.clone(), Material { double_sided: true, ..material }],
            ..Scene::default()
        };
        add(&mut scene, &stage(seen), 0);
        let num_seen = scene.triangles.len();
        if let Some(blocker) = &pair.blocker {
            add(&mut scene, &stage(blocker), 1);
        }
        let mesh = PatchMesh::new(&scene, &MeshSettings::uncut()).expect("a few triangles fit in memory");
        Self { scene, mesh, viewer: stage(viewer), num_seen, ratio }
    }

    /// Share of the view that the larger polygon takes, from each of `num_points` points.
    fn seen(&self, method: &mut dyn FormFactors, num_points: u32) -> Result<Vec<f64>, FormFactorError> {
        map_rows(method, &self.viewpoints(num_points), &|| true, |_, row| {
            let is_seen = |e: usize| self.mesh.elements[e].triangle.index() < self.num_seen;
            row.entries.iter().filter(|entry| is_seen(entry.element.index())).map(|e| f64::from(e.factor)).sum()
        })
    }

    /// `num_points` points spread evenly over the viewer: each triangle of its fan has a sequence of its own, as long as its
    /// share of the area.
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

    fn turned(&self, estimate: Estimate) -> Estimate {
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
        is_back_side: false,
    }));
    scene.instances.push(Instance { name: String::new(), triangles: start..scene.triangles.len() });
}
