// What page/scene3d.js takes of three.js, as the global THREE of one script.
export {
  BufferAttribute, BufferGeometry, Color, ColorManagement, DoubleSide, DynamicDrawUsage, LinearSRGBColorSpace, LineBasicMaterial, LineSegments,
  Mesh, MeshBasicMaterial, PerspectiveCamera, Points, Scene, ShaderMaterial, TOUCH, Vector3, WebGLRenderer,
} from 'three';
export { OrbitControls } from 'three/addons/controls/OrbitControls.js';
