export {
  BufferAttribute, BufferGeometry, Color, DataTexture, FloatType, InterleavedBuffer, InterleavedBufferAttribute, Mesh,
  PerspectiveCamera, RGBAFormat, Scene, ShaderMaterial, SRGBColorSpace, Texture, Vector2, Vector3, WebGLRenderer,
  WebGLRenderTarget,
} from "three";
export { OrbitControls } from "three/addons/controls/OrbitControls.js";
