//! Draws with sub-pixel precision by a library with integer pixels: drawings are ten times as large, then
//! scaled.

/// Units of such a drawing per pixel.
pub const FINE: u32 = 10;

/// Scales a drawing of `size` pixels in units of a tenth of a pixel: its root element gets the display
/// size, its view box retains the units.
pub fn shown_at(svg: &str, (width, height): (u32, u32)) -> String {
    let large = format!("width=\"{}\" height=\"{}\"", FINE * width, FINE * height);
    let shown = format!("width=\"{width}\" height=\"{height}\"");
    svg.replacen(&large, &shown, 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_root_changes_its_size() {
        let large = "<svg width=\"70\" height=\"40\" viewBox=\"0 0 70 40\"><rect width=\"70\" height=\"40\"/></svg>";
        let wanted = "<svg width=\"7\" height=\"4\" viewBox=\"0 0 70 40\"><rect width=\"70\" height=\"40\"/></svg>";
        assert_eq!(shown_at(large, (7, 4)), wanted);
    }
}
