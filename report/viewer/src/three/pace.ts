/**
 * When the next piece of drawing may begin, so that scrolling stays fluid: not before the graphics card, or the
 * processor in its place, has done the last one, and while the page is scrolled only a third of the time is drawn.
 */
export class Pace {
  private fence: WebGLSync | null = null;
  private began = 0;
  private until = 0;

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** True when the next piece may begin at `now`, milliseconds. To be asked every frame: it looks whether the last is done. */
  ready(now: number, scrolling: boolean): boolean {
    if (this.fence) {
      if (this.gl.getSyncParameter(this.fence, this.gl.SYNC_STATUS) !== this.gl.SIGNALED && !this.gl.isContextLost())
        return false;
      this.gl.deleteSync(this.fence);
      this.fence = null;
      this.until = now + 2 * (now - this.began);
    }
    return !scrolling || now >= this.until;
  }

  /** A piece that began at `now` has been handed to the graphics card. */
  handed(now: number): void {
    this.began = now;
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
  }
}
