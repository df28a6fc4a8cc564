/* Frames: the gas is asked to go on as far as the clock on the wall says. */
function tick(now) {
  requestAnimationFrame(tick); /* first: whatever goes wrong in one frame, the next is drawn */
  const seconds = Math.min((now - (page.last || now)) / 1000, 0.25);
  page.last = now;
  if (page.newFrame) {
    page.newFrame = false;
    drawFrame();
  }
  owe(page.about ? seconds : 0);
  if (page.player) tickPlaying(seconds);
  else if (page.about && !page.inFlight && (page.playing || page.wantFrame || page.wantStep)) ask();
  if (now - (page.slow || 0) > 300 && page.changed) {
    page.slow = now;
    page.changed = false;
    showCharts();
  }
  if (now - (page.said || 0) > 8000 && page.frame) {
    page.said = now;
    say();
  }
}

/* Seconds that the gas has yet to go on for are kept while it is not asked; above so many they are lost. `behind` are
 * those lost in frames one after another; from some on that is said. */
const MOST_OWED = 1,
  MOST_BEHIND = 0.7;
function owe(seconds) {
  if (!page.playing || page.player) page.owed = 0;
  else page.owed += seconds;
  page.lost += Math.max(0, page.owed - MOST_OWED);
  page.owed = Math.min(page.owed, MOST_OWED);
}

async function ask() {
  const mine = page.starts,
    step = page.wantStep,
    seconds = step ? 0 : page.owed;
  page.inFlight = true;
  page.owed = 0;
  page.wantFrame = page.wantStep = false;
  try {
    const answer = await page.live.ask("frame", {
      collisions: page.speed * seconds,
      colour: byId("colour").value,
      step,
    });
    if (mine === page.starts) takeFrame(answer, step, seconds);
    else page.wantFrame = true; /* a start came between; if it is refused, the gas before is to be seen */
  } catch (e) {
    if (mine === page.starts) {
      byId("refused").textContent = e.message;
      page.playing = false;
      showPlaying();
    }
  }
  page.inFlight = false;
}

function takeFrame(frame, step, seconds) {
  page.frame = frame;
  page.newFrame = page.changed = true;
  page.frames++;
  const lost = page.lost + (frame.behind ? seconds : 0);
  page.behind = lost > 0 ? page.behind + lost : 0;
  page.lost = 0;
  page.history.add(frame.md, frame.dsmc);
  if (step) showEvent(frame.event);
}

function drawFrame() {
  const { picture, md, event } = page.frame;
  if (md) page.view.draw(picture, md, page.about, { images: byId("images").checked, event });
  else page.view.draw(null, page.frame.dsmc, page.about, {});
  showClock(md || page.frame.dsmc);
}
