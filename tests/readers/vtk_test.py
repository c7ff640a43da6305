"""Grids as VTK image data, both ways: written by the binary in ANTIGRASP_BINARY and read by VTK, and the other way round."""
import os
import subprocess
import sys
import tempfile
import unittest

try:
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter
    import numpy
except ImportError:
    print("skipped: VTK for Python (python3-vtk9) or NumPy is not installed")
    sys.exit(77)  # CTest counts and names it

BINARY = os.environ["ANTIGRASP_BINARY"]
N = 16
SPACING = 2.5  # mm


def ball_in_mm():
    """Distances to a ball of 12 mm off the middle, in mm, order z y x."""
    at = SPACING * (numpy.arange(N) - (N - 1) / 2)
    z, y, x = numpy.meshgrid(at, at, at, indexing="ij")
    return (12 - numpy.sqrt((x - 2)**2 + y**2 + (z + 1)**2)).astype(numpy.float32)


class Vti(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def call(self, *words):
        return subprocess.run([BINARY, *words], cwd=self.folder, capture_output=True, text=True, check=False)

    def run_well(self, *words):
        done = self.call(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def read(self, name):
        reader = vtkXMLImageDataReader()
        reader.SetFileName(self.path(name))
        reader.Update()
        return reader.GetOutput()

    def write(self, name, values, change):
        image = vtkImageData()
        image.SetDimensions(N, N, N)
        image.SetSpacing(SPACING, SPACING, SPACING)
        image.SetOrigin(100, 200, 300)
        array = numpy_to_vtk(values.ravel(), deep=True)
        array.SetName("ImageScalars")
        image.GetPointData().SetScalars(array)
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(self.path(name))
        writer.SetInputData(image)
        change(writer)
        self.assertEqual(writer.Write(), 1)

    def test_vtk_reads_images_names_and_what_is_said_of_them(self):
        for name in ("a.vti", "a.npy"):
            self.run_well("dataset", "make", "prisms", "--count", "2", "--seed", "7", "--out", name)
        image, grids = self.read("a.vti"), numpy.load(self.path("a.npy"))
        self.assertEqual(image.GetDimensions(), (32, 32, 32))
        self.assertEqual(image.GetSpacing(), 3 * (1 / 32,))
        self.assertEqual(image.GetOrigin(), 3 * (-0.484375,))
        points = image.GetPointData()
        self.assertEqual(points.GetNumberOfArrays(), 2)
        for i in range(2):
            self.assertEqual(points.GetArrayName(i), f"prisms-{i:06d}")
            # VTK's points run along x first: the order of z, y, x in NumPy.
            self.assertTrue((vtk_to_numpy(points.GetArray(i)).reshape(32, 32, 32) == grids[i]).all())
        self.assertEqual(points.GetScalars().GetName(), "prisms-000000")
        fields = image.GetFieldData()
        said = {fields.GetArrayName(i): fields.GetAbstractArray(i).GetValue(0)
                for i in range(fields.GetNumberOfArrays())}
        self.assertEqual(said, {
            "format": "antigrasp.sdf", "sign": "positive inside", "unit": "side of the unit cube",
            "kind": "prisms", "seed": 7, "truncation": 0.0,
            "provenance": "prior set prisms, seed 7, count 2"})

    def test_images_of_vtk_are_taken_however_they_are_written(self):
        """Appended or not, packed or not, as text, float64: 16 points of 2.5 mm are a cube of 40 mm."""
        expected = ball_in_mm() / 40
        writers = {
            "default": lambda writer: None,
            "raw": lambda writer: writer.EncodeAppendedDataOff(),
            "plain": lambda writer: writer.SetCompressorTypeToNone(),
            "raw_plain": lambda writer: (writer.SetCompressorTypeToNone(), writer.EncodeAppendedDataOff()),
            "binary": lambda writer: writer.SetDataModeToBinary(),
            "binary_plain": lambda writer: (writer.SetDataModeToBinary(), writer.SetCompressorTypeToNone()),
            "text": lambda writer: writer.SetDataModeToAscii(),
            "short": lambda writer: writer.SetHeaderTypeToUInt32(),
            "blocks": lambda writer: writer.SetBlockSize(4096),
        }
        for kind, change in writers.items():
            for width in (numpy.float32, numpy.float64):
                name = f"{kind}.vti"
                self.write(name, ball_in_mm().astype(width), change)
                self.run_well("dataset", "import", name, "--out", "x.npz")
                with numpy.load(self.path("x.npz")) as file:
                    self.assertEqual([str(one) for one in file["names"]], [kind])
                    self.assertEqual(float(file["side"]), 40.0)
                    self.assertLess(abs(file["sdf"][0] - expected).max(), 1e-6, kind)

    def test_a_folder_of_images_is_one_set_and_other_packing_is_refused(self):
        os.mkdir(self.path("in"))
        for name in ("in/a.vti", "in/b.vti"):
            self.write(name, ball_in_mm(), lambda writer: None)
        self.assertIn("2 shapes (2 accepted", self.run_well("dataset", "import", "in", "--out", "x.h5"))
        self.write("c.vti", ball_in_mm(), lambda writer: writer.SetCompressorTypeToLZ4())
        done = self.call("info", "c.vti")
        self.assertEqual(done.returncode, 2)
        self.assertIn("LZ4", done.stderr)

    def test_true_size_is_the_images(self):
        self.write("ball.vti", ball_in_mm(), lambda writer: None)
        self.run_well("evaluate", "ball.vti", "--true-size", "--units", "mm", "--num-grasps", "5", "--num-draws", "2",
                      "--out", "s.csv")
        with open(self.path("s.csv"), encoding="utf-8") as file:
            head, row = (line.rstrip("\n").split(",") for line in file)
        extent = float(row[head.index("extent_x")])
        self.assertLess(abs(extent - 24), 0.3)


if __name__ == "__main__":
    unittest.main()
