//! Converts triangle strips, fans and lists to separate triangles over the used vertices.

use gltf::json::mesh::Mode;

/// Returns the corners of the triangles that `mode` forms from the vertices listed in `order`.
///
/// Source: glTF 2.0, section 3.7.2.1.
pub(crate) fn triangulate(mode: Mode, order: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => {
            let swap_odd = |(i, w): (usize, &[u32])| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[0], w[2], w[1]] };
            order.windows(3).enumerate().map(swap_odd).collect()
        }
        Mode::TriangleFan => match order.split_first() {
            Some((&hub, rim)) => rim.windows(2).map(|w| [w[0], w[1], hub]).collect(),
            None => Vec::new(),
        },
        _ => order.chunks_exact(3).map(|w| [w[0], w[1], w[2]]).collect(),
    }
}

/// Renumbers corners over the used vertices only, and returns the old indices of these vertices, ascending.
///
/// # Errors
/// Returns the first index that is not below `num_vertices`.
pub(crate) fn keep_used(triangles: &mut [[u32; 3]], num_vertices: usize) -> Result<Vec<u32>, u32> {
    let mut new_index = vec![u32::MAX; num_vertices];
    for &corner in triangles.iter().flatten() {
        *new_index.get_mut(corner as usize).ok_or(corner)? = 0;
    }
    let mut rows = Vec::new();
    for (row, new) in new_index.iter_mut().enumerate().filter(|(_, new)| **new == 0) {
        *new = rows.len() as u32;
        rows.push(row as u32);
    }
    for corner in triangles.iter_mut().flatten() {
        *corner = new_index[*corner as usize];
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn incomplete_topologies_give_no_triangles() {
        assert!(triangulate(Mode::TriangleFan, &[]).is_empty());
        assert!(triangulate(Mode::TriangleStrip, &[0, 1]).is_empty());
        assert_eq!(triangulate(Mode::Triangles, &[0, 1, 2, 3]).len(), 1);
    }
}
