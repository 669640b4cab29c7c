"""Local web server for the page of a train that is being edited. The page is rebuilt when a file of the train is saved.

One page shows the report and the animated train side by side, and stays connected to the server. When the server
announces a new version, the report and the view are reloaded, and the camera position, the crank angle and the selected
state are restored.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from geartrain.errors import GearTrainError, MissingExtraError, Problem, QuestionError
from geartrain.viewer.viewer_page import own_script_only

if TYPE_CHECKING:
    from tornado.web import Application

_SETTLING = 0.1  # [s] an editor may write a file in several steps
_LOCAL = "127.0.0.1"


@dataclass(frozen=True, slots=True)
class LivePages:
    """Report and animated view of a train, as two complete HTML documents."""

    report: str
    view: str


class LiveServer:
    """Web server for the pages of a train, which is reachable only from this computer and runs until it is interrupted.

    Raises `MissingExtraError` if tornado or watchdog is missing, and `QuestionError` if the port cannot be used.

    make      function that builds the pages; if it raises `GearTrainError`, the message is shown above the previous
    pages
    watched   function that returns the files to be watched for changes; it is called after each change
    port      port number, 0 for any free port
    """

    def __init__(self, make: Callable[[], LivePages], watched: Callable[[], Iterable[Path]], port: int = 0) -> None:
        try:
            import tornado.netutil
            import watchdog.observers  # noqa: F401
        except ImportError:
            raise MissingExtraError("tornado or watchdog", "watch", "the live page of a file") from None
        self.make, self.watched = make, watched
        self.pages: LivePages | None = None
        self.error = ""
        self.version = 0
        self._listening: set[Any] = set()
        try:
            self._sockets = tornado.netutil.bind_sockets(port, _LOCAL)
        except (OSError, OverflowError) as error:
            fix = "give another --port, such as --port 0 for any free port"
            raise QuestionError(Problem(f"port {port} cannot be used", str(error), fix)) from None

    @property
    def address(self) -> str:
        """URL of the outer page, which contains the report and the view."""
        return f"http://{_LOCAL}:{self._sockets[0].getsockname()[1]}/"

    def refresh(self) -> None:
        """Rebuild the pages and increment the version; if the train has errors, keep the pages and store the error."""
        try:
            self.pages, self.error = self.make(), ""
        except GearTrainError as error:
            self.error = str(error)
        # counted after an error too, so that open pages show the message
        self.version += 1

    def run(self, report: Callable[[str], object]) -> None:
        """Serve the pages until Ctrl+C is pressed; after each change, call `report` with the error message, or ""."""
        with suppress(KeyboardInterrupt):
            asyncio.run(self._serve(report))

    async def _serve(self, report: Callable[[str], object]) -> None:
        from tornado.httpserver import HTTPServer
        from watchdog.events import FileSystemEvent, FileSystemEventHandler
        from watchdog.observers import Observer

        loop, changed = asyncio.get_running_loop(), asyncio.Event()

        class Saved(FileSystemEventHandler):
            def on_any_event(self, event: FileSystemEvent) -> None:
                if event.event_type in ("modified", "created", "moved", "deleted"):
                    paths = {Path(str(path)).resolve() for path in (event.src_path, event.dest_path) if path}
                    if paths & {path.resolve() for path in known}:
                        # the observer runs in its own thread
                        loop.call_soon_threadsafe(changed.set)

        server = HTTPServer(self._application())
        server.add_sockets(self._sockets)
        observer, known, folders = Observer(), list[Path](), set[Path]()

        def watch() -> None:
            known[:] = self.watched()
            # folders are watched, because editors may replace a file instead of writing it
            for folder in {path.resolve().parent for path in known} - folders:
                observer.schedule(Saved(), str(folder))
                folders.add(folder)

        watch()
        observer.start()
        try:
            while True:
                await changed.wait()
                await asyncio.sleep(_SETTLING)
                changed.clear()
                await loop.run_in_executor(None, self.refresh)
                report(self.error)
                watch()
                for each in tuple(self._listening):
                    each.tell()
        finally:
            observer.stop()
            server.stop()

    def _application(self) -> Application:
        from tornado.web import Application, RequestHandler
        from tornado.websocket import WebSocketClosedError, WebSocketHandler

        live = self
        shell = files(__package__).joinpath("live.html").read_text(encoding="utf-8")
        policy = self._policy(shell)

        class Shown(RequestHandler):
            def get(self, name: str) -> None:
                pages = live.pages
                text = shell if not name else "" if pages is None else getattr(pages, name)
                self.set_header("Cache-Control", "no-store")
                if not name:  # the two inner pages have their own policies
                    self.set_header("Content-Security-Policy", policy)
                self.finish(text)

        class Changes(WebSocketHandler):
            def open(self, *args: str, **kwargs: str) -> None:
                live._listening.add(self)
                self.tell()

            def tell(self) -> None:
                try:
                    self.write_message({"version": live.version, "error": live.error})
                except WebSocketClosedError:
                    live._listening.discard(self)

            def on_close(self) -> None:
                live._listening.discard(self)

        # requests for other host names are not answered (DNS rebinding)
        application = Application(log_function=lambda handler: None)
        application.add_handlers(r"(127\.0\.0\.1|localhost)", [(r"/(report|view|)", Shown), (r"/changes", Changes)])
        return application

    def _policy(self, shell: str) -> str:
        """Return the content security policy of the outer page: its own script, frames and socket of this server."""
        script = shell.partition("<script>")[2].partition("</script>")[0]
        port = self._sockets[0].getsockname()[1]
        reached = f"frame-src 'self'; connect-src ws://{_LOCAL}:{port} ws://localhost:{port}; frame-ancestors 'none'"
        return f"{own_script_only(script)}; img-src data:; {reached}"
