"""The true ends of the benchmark's tooth shapes: distance of the last contact, and pressure angle there (rad).

The six problems in 40 digits: power series at the pitch point, computed coefficient by coefficient, then Taylor
marching over X; least friction from its two closed conditions, its second number being the length of the ray. Extreme
pairs by extrapolated midpoint rules in 64-bit mantissas, with steps that grow with the distance, agreeing to 2e-16
with steps half as long, and with the 40 digits where both were made.
"""

TRUTH: dict[str, tuple[str, str]] = {
    "stress spur": ("1.4789223730305230753268739", "0.3405610050799221591004142895"),
    "heat spur": ("1.544023073826428323798365578", "0.3235970102211223890034431379"),
    "friction spur": ("1.480392128830756251584872297", "0.3563150801725634547043993281"),
    "stress bevel": ("0.06845745099294365295110253705", "0.3318307392217568384009115601"),
    "heat bevel": ("0.07201308173503794394161025678", "0.2234245214278718038394431582"),
    "friction bevel": ("0.0685388123918610858263212436", "0.01673046201786650733125096872"),
    "stress spur 24/36, 0.1 deg": ("1.570284019773850101", "0.044011302260835866"),
    "stress spur 24/36, 1 deg": ("1.569998723745413890", "0.049332719881808138"),
    "stress spur 24/36, 5 deg": ("1.564687569034173246", "0.095682124582530612"),
    "stress spur 24/36, 44 deg": ("1.140206653052408696", "0.750080371597155309"),
    "stress spur 24/36, 44.9 deg": ("1.123450841973459886", "0.765132538288431833"),
    "stress spur 5/5, 20 deg": ("1.440083761750824515", "0.507640239563352648"),
    "heat spur 5/5, Q 1.2": ("1.360634921238581443", "0.994039469846062599"),
    "stress spur 5/1000, 20 deg": ("1.516424401217146961", "0.190934527113315725"),
    "heat spur 5/1000, Q 0.8": ("1.527944147162059788", "0.413485390649578797"),
    "stress spur 100000/100000, 20 deg": ("1.476065716947010271", "0.349065850955956254"),
    "heat spur 100000/100000, Q 0.8": ("1.570796326003590555", "0.000054977871467495"),
    "stress crown 24/36, 20 deg": ("0.082478857928226441", "0.316848320661755150"),
    "heat crown 24/36, Q 0.5": ("0.087127573170949315", "0.097862617744900267"),
    "stress bevel 40/40 at 176 deg, 20 deg": ("0.073754645802178464", "0.349477188265257124"),
    "heat bevel 40/40 at 176 deg, Q 0.5": ("0.078491357333429819", "0.006856084893181371"),
    "stress bevel 5/1000 at 90 deg, 20 deg": ("0.003033330277917600", "0.189353848144972036"),
    "heat bevel 5/1000 at 90 deg, Q 0.5": ("0.002908759954681040", "0.713573324528897461"),
}
