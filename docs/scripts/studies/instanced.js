// three.js's own example of instances (webgl_instancing_raycast), as large as a train: balls of 1280 triangles in a cube,
// of its standard metal under the lamps that the viewer has; after `room` in three.js's own room, which the metal mirrors. `frame(turn)` draws one picture and waits until it is there.
import { AmbientLight, DirectionalLight, DoubleSide, IcosahedronGeometry, InstancedMesh, Matrix4, MeshStandardMaterial, PerspectiveCamera, PMREMGenerator, Scene, WebGLRenderer } from "three";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";

const [triangles, room] = location.hash.slice(1).split(",");
const canvas = document.querySelector("canvas");
const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: false, stencil: false });
renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
renderer.setClearColor("#f4f1ea");

const ball = new IcosahedronGeometry(0.5, 7);
const each = ball.attributes.position.count / 3;
const count = Math.round(triangles / each);
const side = Math.ceil(Math.cbrt(count));
const metal = new MeshStandardMaterial({ color: "#c8963c", metalness: 0.6, roughness: 0.4, side: DoubleSide });
const balls = new InstancedMesh(ball, metal, count);
const middle = (side - 1) / 2;
for (let n = 0; n < count; n += 1) {
  const [x, y, z] = [n % side, Math.floor(n / side) % side, Math.floor(n / side ** 2)];
  balls.setMatrixAt(n, new Matrix4().makeTranslation(x - middle, y - middle, z - middle));
}
const scene = new Scene();
if (room) scene.environment = new PMREMGenerator(renderer).fromScene(new RoomEnvironment(), 0.04).texture;
scene.add(balls, new AmbientLight("#ffffff", 1));
for (const [x, y, z, strength] of [[-0.45, 0.68, 0.58, 2], [0.75, 0.1, 0.65, 0.7]]) {
  const lamp = new DirectionalLight("#ffffff", strength);
  lamp.position.set(x, y, z);
  scene.add(lamp);
}
const camera = new PerspectiveCamera(26, canvas.clientWidth / canvas.clientHeight, 0.1, 1000);
camera.position.setScalar(2.4 * side);
camera.lookAt(0, 0, 0);

globalThis.instanced = {
  triangles: count * each,
  frame(turn) {
    balls.rotation.y = turn;
    renderer.render(scene, camera);
    const context = renderer.getContext();
    context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
  },
};
