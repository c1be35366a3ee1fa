"""What pages take as given: an elevation raster and a map extract, small and made up."""

import numpy as np
from osgeo import gdal, osr

LATITUDE, LONGITUDE = 43.0, -3.0
DEGREES_PER_M = 1.0 / 111_132.0, 1.0 / 81_541.0  # of latitude and of longitude, at 43 degrees north


def elevation(path):
    """300 m a side of a slope of one in thirty, in UTM."""
    geographic, projected = osr.SpatialReference(), osr.SpatialReference()
    geographic.ImportFromEPSG(4326)
    projected.ImportFromEPSG(32630)
    geographic.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    east, north, _ = osr.CoordinateTransformation(geographic, projected).TransformPoint(LONGITUDE, LATITUDE)
    rows = 30
    heights = np.repeat(np.arange(rows, 0, -1.0)[:, None] / 3.0, rows, axis=1).astype(np.float32)
    raster = gdal.GetDriverByName("GTiff").Create(str(path), rows, rows, 1, gdal.GDT_Float32)
    raster.SetGeoTransform((east - 150.0, 10.0, 0.0, north + 150.0, 0.0, -10.0))
    raster.SetProjection(projected.ExportToWkt())
    raster.GetRasterBand(1).WriteArray(heights)


def extract(path):
    """Houses in rows, some with heights, some with levels, some with neither."""
    nodes, ways = [], []
    for number, (x, y) in enumerate((x, y) for x in range(-100, 101, 40) for y in range(-100, 101, 50)):
        corners = [(x, y), (x + 15, y), (x + 15, y + 10), (x, y + 10)]
        for corner, (east, north) in enumerate(corners):
            nodes.append(f'<node id="{10 * number + corner + 1}" lat="{LATITUDE + north * DEGREES_PER_M[0]:.8f}" '
                         f'lon="{LONGITUDE + east * DEGREES_PER_M[1]:.8f}" version="1"/>')
        refs = "".join(f'<nd ref="{10 * number + corner + 1}"/>' for corner in (0, 1, 2, 3, 0))
        told = ['<tag k="height" v="9"/>', '<tag k="building:levels" v="2"/>', ""][number % 3]
        ways.append(f'<way id="{number + 1}" version="1">{refs}<tag k="building" v="yes"/>{told}</way>')
    path.write_text('<?xml version="1.0"?>\n<osm version="0.6">\n' + "\n".join(nodes + ways) + "\n</osm>\n")
