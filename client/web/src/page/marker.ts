import { DoubleSide, Mesh, MeshBasicMaterial, RingGeometry, type PerspectiveCamera, type Scene } from "three";

/** A ring around the place that is looked at, in front of everything and as large at any distance. What is in it stays to be seen. */
export class Marker {
  private readonly rings = [
    new Mesh(new RingGeometry(0.75, 1.15, 48), ring(0xffffff)),
    new Mesh(new RingGeometry(0.85, 1.05, 48), ring(0xd6009f)),
  ];

  constructor(scene: Scene) {
    this.rings.forEach((one, n) => (one.renderOrder = 1 + n));
    this.visible = false;
    scene.add(...this.rings);
  }

  set visible(is: boolean) {
    for (const one of this.rings) one.visible = is;
  }

  put(place: { x: number; y: number; z: number }): void {
    for (const one of this.rings) one.position.set(place.x, place.y, place.z);
    this.visible = true;
  }

  /** Towards a camera whose picture is so many pixels high. */
  face(camera: PerspectiveCamera, pixels: number): void {
    const radius = 18; // pixels
    for (const one of this.rings) {
      const high = 2 * camera.position.distanceTo(one.position) * Math.tan((camera.fov * Math.PI) / 360);
      one.quaternion.copy(camera.quaternion);
      one.scale.setScalar((radius * high) / pixels);
    }
  }
}

function ring(color: number): MeshBasicMaterial {
  return new MeshBasicMaterial({ color, depthTest: false, depthWrite: false, transparent: true, side: DoubleSide });
}
